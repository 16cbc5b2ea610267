#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/apps/command.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;

TEST_CASE("list names the modules, all or of one category") {
  const auto all = ppm_command({"list", "--names"});
  CHECK(all->code == 0);
  const auto names = lines(all->out);
  CHECK(std::is_sorted(names.begin(), names.end()));
  CHECK(std::count(names.begin(), names.end(), "motion.constant_velocity") == 1);

  const auto motion = ppm_command({"list", "motion"});
  CHECK(motion->code == 0);
  for (const auto& line : lines(motion->out)) CHECK(line.rfind("motion.", 0) == 0);
  CHECK(lines(motion->out).size() >= 2);

  const auto wrong = ppm_command({"list", "motoin"});
  CHECK(wrong->code == 2);
  CHECK(wrong->err == "no category 'motoin'; did you mean 'motion'?\n");
}

TEST_CASE("describe tells parameters with units, as text and as a page") {
  const auto text = ppm_command({"describe", "motion.constant_velocity"});
  CHECK(text->code == 0);
  CHECK_THAT(text->out, Contains("sigma_t") && Contains("0.02") && Contains("frame"));
  const auto page = ppm_command({"describe", "motion.constant_velocity", "--markdown"});
  CHECK_THAT(page->out, Contains("# motion.constant_velocity") && Contains("|"));

  const auto wrong = ppm_command({"describe", "motion.constant_velocty"});
  CHECK(wrong->code == 2);
  CHECK_THAT(wrong->err, Contains("did you mean 'motion.constant_velocity'?"));
  CHECK_THAT(ppm_command({"describe", "zzz"})->err, Contains("ppm list"));
  CHECK_THAT(ppm_command({"describe"})->err, Contains("MODULE or --pages FOLDER"));
}

TEST_CASE("schema is JSON that knows every module") {
  const auto schema = ppm_command({"schema"});
  REQUIRE(schema->code == 0);
  const auto json = nlohmann::json::parse(schema->out);
  CHECK(json["$schema"].get<std::string>().find("2020-12") != std::string::npos);
  for (const auto& name : lines(ppm_command({"list", "--names"})->out))
    CHECK_THAT(schema->out, Contains('"' + name + '"'));
}

TEST_CASE("graph prints the wiring, as text and for Graphviz") {
  SmallRoom room;
  const auto text = ppm_command({"graph", room.graph});
  CHECK(text->code == 0);
  for (const char* node : {"camera", "init", "motion", "look", "weigh", "pick", "update"})
    CHECK_THAT(text->out, Contains(node));
  const auto dot = ppm_command({"graph", room.graph, "--dot"});
  CHECK(dot->code == 0);
  CHECK_THAT(dot->out, Contains("digraph") && Contains("->"));
}

TEST_CASE("check runs nothing") {
  SmallRoom room;
  const auto check = ppm_command({"check", room.graph});
  CHECK(check->code == 0);
  CHECK_THAT(check->out, Contains("graph 'small' with 10 nodes is sound"));
  CHECK_FALSE(std::filesystem::exists(room.out));
}

TEST_CASE("output that cannot be written is an error") {
  Process schema({"/bin/sh", "-c", PPM_BINARY " schema > /dev/full"});
  schema.wait();
  CHECK(schema.code == 1);
  CHECK_THAT(schema.err, Contains("No space left on device"));
}
