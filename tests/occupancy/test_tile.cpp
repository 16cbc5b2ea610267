#include <catch2/catch.hpp>

#include "modules/maps/vdb/tile.hpp"

using namespace ppm;

TEST_CASE("a tile's voxels are found by coordinates, in OpenVDB's order") {
  CHECK(vdb_voxel(0, 0, 1) == 1);
  CHECK(vdb_voxel(0, 1, 0) == 8);
  CHECK(vdb_voxel(9, 0, 0) == 64);
  CHECK(vdb_voxel(-1, -1, -1) == 511);
  CHECK(vdb_leaf(0, 0, 8) == 1);
  CHECK(vdb_leaf(8, 0, 7) == 4);
  CHECK(vdb_leaf(-1, -16, -8) == 5);
  for (int n = 0; n < kVdbTileLeaves; ++n) {
    const Cell at = VdbTile::offset(n);
    CHECK(vdb_leaf(at.x(), at.y(), at.z()) == n);
  }
}

TEST_CASE("a leaf that becomes uniform is a constant again, and gives back its memory") {
  VdbTile tile({16, -32, 0}, kVdbUnknown);
  CHECK(tile.origin() == Cell(16, -32, 0));
  const auto empty = tile.bytes();
  CHECK(tile.uniform());
  VdbCode* codes = tile.write(3);
  CHECK(codes[17] == kVdbUnknown);
  codes[17] = 5;
  tile.settle(3);
  CHECK_FALSE(tile.uniform());
  CHECK(tile.leaf(3)[17] == 5);
  CHECK(tile.bytes() > empty + 1024);
  CHECK(tile.value(16 + 0, -32 + 8 + 2, 8 + 1) == 5);
  std::fill(tile.write(3), tile.write(3) + kVdbLeafVoxels, VdbCode(-7));
  tile.settle(3);
  CHECK(tile.leaf(3) == nullptr);
  CHECK(tile.constant(3) == -7);
  CHECK(tile.bytes() == empty);
  CHECK_FALSE(tile.uniform());
  tile.set_constant(3, kVdbUnknown);
  CHECK(tile.uniform());
}

TEST_CASE("a copy of a tile shares nothing with it") {
  VdbTile tile({0, 0, 0}, 1);
  tile.write(2)[0] = 9;
  tile.settle(2);
  VdbTile copy(tile);
  CHECK(copy.leaf(2) != tile.leaf(2));
  CHECK(copy.leaf(2)[0] == 9);
  CHECK(copy.constant(5) == 1);
  CHECK(copy.origin() == tile.origin());
  copy.write(2)[0] = 3;
  copy.write(5)[1] = 4;
  CHECK(tile.leaf(2)[0] == 9);
  CHECK(tile.leaf(5) == nullptr);
}
