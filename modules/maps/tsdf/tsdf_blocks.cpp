#include "modules/maps/tsdf/tsdf_blocks.hpp"

#include <bit>

namespace ppm {

TsdfBlocks::TsdfBlocks(const std::vector<Entry>& blocks)
    : slots_(std::bit_ceil(2 * blocks.size() + 1), Entry{Eigen::Vector3i::Zero(), nullptr}) {
  for (const auto& entry : blocks) {
    auto slot = slot_of(entry.first);
    while (slots_[slot].second) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = entry;
  }
}

std::size_t TsdfBlocks::slot_of(const Eigen::Vector3i& place) const {
  const auto mixed = static_cast<std::uint32_t>(place.x()) * 73856093u ^ static_cast<std::uint32_t>(place.y()) * 19349663u ^
                     static_cast<std::uint32_t>(place.z()) * 83492791u;
  return (mixed ^ mixed >> 15) & (slots_.size() - 1);
}

const TsdfBlock* TsdfBlocks::find(const Eigen::Vector3i& place) const {
  if (slots_.empty()) return nullptr;
  auto slot = slot_of(place);
  while (slots_[slot].second && slots_[slot].first != place) slot = (slot + 1) & (slots_.size() - 1);
  return slots_[slot].second;
}

}  // namespace ppm
