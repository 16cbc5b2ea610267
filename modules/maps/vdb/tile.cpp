#include "modules/maps/vdb/tile.hpp"

#include <openvdb/tree/InternalNode.h>
#include <openvdb/tree/LeafNode.h>

#include <algorithm>

namespace ppm {
namespace {

using Leaf = openvdb::tree::LeafNode<VdbCode, kVdbLeafLog2>;
using Internal = openvdb::tree::InternalNode<Leaf, kVdbTileLog2>;
constexpr std::int64_t kAllocation = 16;  // what an allocation costs beside its bytes, about

openvdb::Coord coord(const Cell& c) { return {c.x(), c.y(), c.z()}; }

}  // namespace

struct VdbTile::Node : Internal {
  using Internal::Internal;
  Leaf* child(int n) { return isChildMaskOn(index(n)) ? getTable()[n].getChild() : nullptr; }
  const Leaf* child(int n) const { return isChildMaskOn(index(n)) ? getTable()[n].getChild() : nullptr; }
  static openvdb::Index index(int n) { return static_cast<openvdb::Index>(n); }
};

VdbTile::VdbTile(const Cell& origin, VdbCode value)
    : node_(std::make_unique<Node>(coord(origin), value, value != kVdbUnknown)) {
  constant_.fill(value);
  occupied_.fill(value > 0);
}

// Leaf by leaf: InternalNode's own copy starts parallel tasks, which must not happen inside those of particles.
VdbTile::VdbTile(const VdbTile& other)
    : node_(std::make_unique<Node>(other.node_->origin(), kVdbUnknown, false)),
      constant_(other.constant_),
      occupied_(other.occupied_) {
  for (int n = 0; n < kVdbTileLeaves; ++n) {
    if (const Leaf* leaf = other.node_->child(n)) {
      auto* copy = new Leaf(*leaf);
      node_->addLeaf(copy);
      codes_[static_cast<std::size_t>(n)] = copy->buffer().data();
    } else {
      node_->addTile(Node::index(n), constant(n), constant(n) != kVdbUnknown);
    }
  }
}

VdbTile::~VdbTile() = default;

Cell VdbTile::origin() const {
  const auto& o = node_->origin();
  return {o.x(), o.y(), o.z()};
}

VdbCode* VdbTile::write(int leaf) {
  auto& codes = codes_[static_cast<std::size_t>(leaf)];
  if (!codes) {
    auto* made = new Leaf(coord(origin() + offset(leaf)), constant(leaf), constant(leaf) != kVdbUnknown);
    node_->addLeaf(made);
    codes = made->buffer().data();
  }
  return codes;
}

void VdbTile::set_constant(int leaf, VdbCode value) {
  node_->addTile(Node::index(leaf), value, value != kVdbUnknown);  // drops the leaf
  codes_[static_cast<std::size_t>(leaf)] = nullptr;
  constant_[static_cast<std::size_t>(leaf)] = value;
  occupied_[static_cast<std::size_t>(leaf)] = value > 0;
}

void VdbTile::settle(int leaf) {
  const VdbCode* codes = codes_[static_cast<std::size_t>(leaf)];
  if (!codes) return;
  if (std::all_of(codes, codes + kVdbLeafVoxels, [&](VdbCode c) { return c == codes[0]; }))
    return set_constant(leaf, codes[0]);
  occupied_[static_cast<std::size_t>(leaf)] = *std::max_element(codes, codes + kVdbLeafVoxels) > 0;
  auto& mask = node_->child(leaf)->getValueMask();
  for (openvdb::Index word = 0; word < kVdbLeafVoxels / 64; ++word) {
    std::uint64_t bits = 0;
    for (openvdb::Index b = 0; b < 64; ++b)
      bits |= static_cast<std::uint64_t>(codes[64 * word + b] != kVdbUnknown) << b;
    mask.getWord<openvdb::Index64>(word) = bits;
  }
}

bool VdbTile::uniform() const {
  return std::all_of(codes_.begin(), codes_.end(), [](const VdbCode* codes) { return !codes; }) &&
         std::all_of(constant_.begin(), constant_.end(), [&](VdbCode c) { return c == constant_[0]; });
}

std::int64_t VdbTile::bytes() const {
  const auto leaves = kVdbTileLeaves - std::count(codes_.begin(), codes_.end(), nullptr);
  constexpr std::int64_t leaf_bytes = sizeof(Leaf) + sizeof(VdbCode) * kVdbLeafVoxels + 2 * kAllocation;
  return static_cast<std::int64_t>(sizeof(VdbTile) + sizeof(Node)) + 2 * kAllocation + leaves * leaf_bytes;
}

}  // namespace ppm
