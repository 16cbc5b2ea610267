#include <catch2/catch.hpp>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <cstdio>
#include <iostream>

#include "framework/graph/harness.hpp"
#include "modules/maps/vdb/vdb_reader.hpp"
#include "tests/occupancy/occupancy_world.hpp"
#include "tests/support/registry.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;

namespace {

/// The file that the module writes of a map.
std::string written(const MapHandle& map, const test::TempFolder& folder) {
  Harness h(test::builtin(), "sink.map_vdb", "{}", 1, 1, folder.path());
  h.belief().init(1, Pose::Identity(), map);
  h.tick();
  return (folder / "map.vdb").string();
}

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  ::pclose(pipe);
  return text;
}

}  // namespace

TEST_CASE("sink.map_vdb writes every voxel where it is") {
  test::TempFolder folder;
  OccupancySettings settings;
  settings.memory = 4;  // so that much free space settles at the clamp
  const auto map = test::box_map(test::empty_grid(0.05, -1, 2), 0, 30, settings);
  openvdb::initialize();
  openvdb::io::File file(written(map, folder));
  file.open();
  const auto log_odds = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("log_odds"));
  const auto occupancy = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("occupancy"));
  CHECK(occupancy->getGridClass() == openvdb::GRID_FOG_VOLUME);
  CHECK(log_odds->indexToWorld(openvdb::Coord(0, 0, 2)).z() == Approx(0.125));
  VdbReader reader(*map);
  std::size_t known = 0, occupied = 0;
  for (int x = -30; x < 30; ++x)
    for (int y = -30; y < 30; ++y)
      for (int z = -30; z < 30; ++z) {
        const openvdb::Coord at(x, y, z);
        const VdbCode code = reader(x, y, z);
        known += code != kVdbUnknown;
        occupied += code > 0;
        REQUIRE(log_odds->tree().isValueOn(at) == (code != kVdbUnknown));
        REQUIRE(occupancy->tree().isValueOn(at) == (code > 0));
        if (code != kVdbUnknown) REQUIRE(log_odds->tree().getValue(at) == Approx(code * map->step()));
      }
  CHECK(log_odds->activeVoxelCount() == known);
  CHECK(occupancy->activeVoxelCount() == occupied);
  CHECK(occupied > 1000);
}

TEST_CASE("OpenVDB's own program opens what sink.map_vdb writes") {
  test::TempFolder folder;
  const auto file = written(test::box_map(test::empty_grid(0.05), 0, 2), folder);
  if (output_of("command -v vdb_print").empty()) {
    std::cout << "SKIPPED: vdb_print is not installed (libopenvdb-tools)\n";
    return;
  }
  const auto text = output_of("vdb_print " + file);
  INFO(text);
  CHECK(text.find("log_odds") != std::string::npos);
  CHECK(text.find("occupancy") != std::string::npos);
}
