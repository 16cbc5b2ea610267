#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "framework/graph/harness.hpp"
#include "tests/support/registry.hpp"
#include "tests/support/temp_folder.hpp"

namespace {

/// 100 bytes of its own, 1,000 bytes that every block map shares.
class BlockMap final : public ppm::Map {
 public:
  std::string_view kind() const override { return "block"; }
  ppm::MapStats stats() const override {
    ppm::MapStats s;
    s.bytes = 1100;
    return s;
  }
  std::int64_t account(std::unordered_set<const void*>& seen) const override {
    static const char common = 0;
    return (seen.insert(&common).second ? 1000 : 0) + (seen.insert(this).second ? 100 : 0);
  }
  void digest(ppm::Digest&) const override {}
  ppm::Mesh mesh(ppm::Surface) const override { return {}; }
};

std::vector<std::vector<std::string>> read_csv(const std::filesystem::path& file) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    rows.emplace_back();
    std::istringstream fields(line + ",");
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

}  // namespace

TEST_CASE("the metrics sink writes a row a frame") {
  ppm::test::TempFolder out;
  ppm::Harness h(ppm::test::builtin(), "sink.metrics", "{memory_every: 2, ancestry_every: 2}", 1, 1, out.path());
  auto& belief = h.belief();
  belief.init(3, ppm::Pose::Identity(), std::make_shared<BlockMap>());
  belief.map[2] = std::make_shared<BlockMap>();
  for (int k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) belief.extend(i, {5 + 10 * k, 0.1 * k, ppm::Pose::Identity()});
    h.tick();
  }
  h.close();
  const auto rows = read_csv(out / "metrics.csv");
  REQUIRE(rows.size() == 4);
  const auto& header = rows[0];
  auto field = [&](std::size_t row, const std::string& name) {
    const auto at = std::find(header.begin(), header.end(), name) - header.begin();
    REQUIRE(at < static_cast<std::ptrdiff_t>(header.size()));
    return rows[row][static_cast<std::size_t>(at)];
  };
  CHECK(header[0] == "frame");
  CHECK(field(1, "frame") == "0");
  CHECK(field(3, "sink.metrics.frame_index") == "25");
  CHECK(field(1, "sink.metrics.particles") == "3");
  CHECK(std::stod(field(1, "sink.metrics.ess")) == Approx(3));
  CHECK(std::stod(field(1, "sink.metrics.best_log_weight")) == Approx(-std::log(3.0)));
  // Two maps: 100 bytes each and 1,000 in common; without sharing three times 1,100.
  CHECK(field(1, "sink.metrics.map_bytes_owned") == "1200");
  CHECK(field(1, "sink.metrics.map_bytes_alone") == "3300");
  CHECK(field(2, "sink.metrics.map_bytes_owned").empty());
  CHECK(field(3, "sink.metrics.map_bytes_owned") == "1200");
  // Three paths that share nothing, three poses each.
  CHECK(field(1, "sink.metrics.ancestry_nodes") == "3");
  CHECK(field(2, "sink.metrics.ancestry_nodes").empty());
  CHECK(field(3, "sink.metrics.ancestry_nodes") == "9");
  CHECK(field(3, "sink.metrics.branchings") == "0");
  CHECK(field(3, "sink.metrics.coalescence_frames") == "3");
  CHECK(field(3, "sink.metrics.spread_m") == "0");
  CHECK(field(3, "sink.metrics.spread_deg") == "0");
}
