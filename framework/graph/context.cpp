#include "framework/graph/context.hpp"

#include "framework/core/error.hpp"

namespace ppm {

Rng Context::rng(std::string_view purpose, std::size_t particle) const {
  // The node's name is part of the key, so that two nodes of one module draw different numbers.
  std::uint32_t key = purpose_key(purpose) ^ (node_key_ * 0x9E3779B1u);
  return Rng(seed_, static_cast<std::uint32_t>(frame_), static_cast<std::uint32_t>(particle), key);
}

void Context::metric(std::string_view name, double value) {
  metrics_.record(frame_, fmt::format("{}.{}", node_, name), value);
}

std::filesystem::path Context::output(const std::string& file_name) const {
  PPM_CHECK(!out_dir_.empty(), "node '{}' writes '{}', but the run has no directory", node_, file_name);
  return out_dir_ / file_name;
}

void Context::enter(const std::string& node) {
  node_ = node;
  node_key_ = purpose_key(node);
}

}  // namespace ppm
