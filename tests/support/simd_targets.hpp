#pragma once
#include <catch2/catch.hpp>
#include <hwy/targets.h>

namespace ppm::test {

/// Calls check() once for each instruction set that kernels are compiled for and that this machine has.
template <class Check>
void on_every_target(const Check& check) {
  for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    CAPTURE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace ppm::test
