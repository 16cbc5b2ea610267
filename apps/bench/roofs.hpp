#pragma once
#include <cstddef>

namespace ppm {

struct FlopsDone {
  double flops;  ///< operations: two a multiply-add and lane
  float result;  ///< of no meaning; it depends on all of them
};
/// Multiply-adds that do not wait for each other, ten a round, on the widest registers that the processor has.
FlopsDone multiply_adds(std::size_t rounds);
/// The sum of an array, read by the widest loads. data: aligned to 64 bytes, n a multiple of 256.
float read_sum(const float* data, std::size_t n);
/// The instruction set that both use: "AVX3".
const char* roof_target();

}  // namespace ppm
