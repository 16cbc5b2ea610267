#pragma once
#include "framework/core/parallel.hpp"

namespace ppm::test {

/// For calls whose parallelism is not what a test is about.
inline const Workers& one_worker() {
  static const Workers workers(1);
  return workers;
}

}  // namespace ppm::test
