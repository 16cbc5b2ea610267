#include <catch2/catch.hpp>
#include <fmt/core.h>

#include "tests/apps/command.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kTable =
    "frame,find.lost,look.ms,weigh.ess,weigh.outlier_share\n"
    "0,0,,,\n"
    "1,0,,5,0.01\n"
    "2,1,,1,0.5\n"
    "3,1,1,nan,0.6\n"
    "4,0,,4,0.02\n";

/// Width and height of a PNG.
std::pair<unsigned, unsigned> size_of(const std::filesystem::path& file) {
  const auto bytes = content(file);
  REQUIRE(bytes.substr(1, 3) == "PNG");
  auto number = [&](std::size_t at) {
    unsigned n = 0;
    for (std::size_t k = 0; k < 4; ++k) n = n << 8 | static_cast<unsigned char>(bytes[at + k]);
    return n;
  };
  return {number(16), number(20)};
}

}  // namespace

TEST_CASE("plot draws what tells how the filter does, or the columns that are named") {
  TempFolder run;
  write_text(run / "metrics.csv", kTable);
  const auto folder = run.path().string();
  const auto all = ppm_command({"plot", folder});
  INFO(all->err);
  REQUIRE(all->code == 0);
  const auto [cols, rows] = size_of(run / "metrics.png");
  CHECK(cols == 1200);
  REQUIRE(ppm_command({"plot", folder, "ess", "look.ms", "--out", (run / "two.png").string(), "--width", "600"})->code == 0);
  const auto [narrow, low] = size_of(run / "two.png");
  CHECK(narrow == 600);
  CHECK(rows - low == (rows - 30) / 3);  // find.lost, ess and outlier_share against two
}

TEST_CASE("plot: what is wrong") {
  TempFolder run;
  auto complaint = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"plot", run.path().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto command = ppm_command(std::move(arguments));
    CHECK(command->code == 2);
    return command->err;
  };
  CHECK_THAT(complaint({}), Contains("metrics.csv") && Contains("sink.metrics"));
  write_text(run / "metrics.csv", kTable);
  CHECK_THAT(complaint({"outlier_shard"}), Contains("did you mean 'outlier_share'?"));
  write_text(run / "metrics.csv", "frame,a\n0,1\n1,x\n");
  CHECK_THAT(complaint({"a"}), Contains("metrics.csv:3:1") && Contains("'x'"));
  write_text(run / "metrics.csv", "frame,a\n0,1,2\n");
  CHECK_THAT(complaint({"a"}), Contains("3 fields"));
  write_text(run / "metrics.csv", "frame,a\n0,1\n");
  CHECK_THAT(complaint({}), Contains("name some"));
  write_text(run / "metrics.csv", "stamp,a\n0,1\n");
  CHECK_THAT(complaint({}), Contains("no table of metrics"));
}
