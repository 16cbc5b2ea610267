#include <catch2/catch.hpp>
#include <regex>

#include "apps/report/html_text.hpp"
#include "apps/report/report.hpp"
#include "framework/core/error.hpp"
#include "modules/maps/picture/png_encoder.hpp"
#include "tests/report/suite_fixture.hpp"

using namespace ppm;
using namespace ppm::test;
using Catch::Matchers::Contains;
using Json = nlohmann::json;

namespace {

Json report_of(const SuiteFixture& suite) {
  write_report(suite.path());
  return Json::parse(content(suite.path() / "report.json"));
}

const Json& entry(const Json& list, const std::map<std::string, std::string>& wanted) {
  for (const auto& item : list) {
    bool fits = true;
    for (const auto& [key, value] : wanted) fits = fits && item.at(key) == value;
    if (fits) return item;
  }
  FAIL("no such entry");
  return list;
}

/// Every start tag has its end tag, in order.
void check_nesting(const std::string& html) {
  static const std::regex tag(R"(<(/?)([a-z0-9]+)[^>]*?(/?)>)");
  std::vector<std::string> open;
  for (std::sregex_iterator it(html.begin(), html.end(), tag), end; it != end; ++it) {
    const std::string name = (*it)[2];
    if ((*it)[3].length() || name == "meta" || name == "img") continue;
    if (!(*it)[1].length()) {
      open.push_back(name);
      continue;
    }
    REQUIRE_FALSE(open.empty());
    REQUIRE(open.back() == name);
    open.pop_back();
  }
  CHECK(open.empty());
}

}  // namespace

TEST_CASE("a finished suite: four files, the same bytes again, nothing from outside") {
  SuiteFixture suite;
  suite.write();
  const auto json = report_of(suite);
  const auto html = content(suite.path() / "report.html");
  const auto csv = content(suite.path() / "runs.csv"), md = content(suite.path() / "report.md");
  check_nesting(html);
  for (const char* word : {"http:", "https:", "<script", "<link", "@import", "url("})
    CHECK(html.find(word) == std::string::npos);
  CHECK_THAT(html,
             Contains("A suite &amp; its &lt;runs&gt;") && Contains("OpenVDB &lt;5 cm&gt;") && Contains("&lt;not&gt;"));
  CHECK(html.find("<5 cm>") == std::string::npos);
  CHECK_THAT(html, Contains("ppm run &#39;runs/main/room/fine[init.size=1 cm]/seed_3/graph.yaml&#39; --seed 3"));
  CHECK(html.find("/some/where") == std::string::npos);
  CHECK(std::ranges::count(csv, '\n') == 1 + 5 * 2 * 5);
  CHECK_THAT(md, Contains("| PPM | 8.00 [7.68, 8.32] |"));
  write_report(suite.path());
  CHECK(content(suite.path() / "report.html") == html);
  CHECK(content(suite.path() / "runs.csv") == csv);
  CHECK(content(suite.path() / "report.md") == md);
  CHECK(Json::parse(content(suite.path() / "report.json")) == json);
}

TEST_CASE("paired differences are decided by their interval, the losses come first") {
  SuiteFixture suite;
  suite.write();
  const auto json = report_of(suite)["comparisons"][0];
  const auto& differences = json["differences"];
  CHECK(differences[0]["verdict"] == "worse");
  CHECK(differences.back()["verdict"] == "better");
  const auto& ate =
      entry(differences, {{"sequence", "room"}, {"other", "vdb_2cm"}, {"measure", "trajectory.ate_rmse_m"}});
  CHECK(ate["verdict"] == "worse");
  CHECK(ate["basis"] == "interval");
  CHECK(ate["median"].get<double>() == Approx(0.5));
  CHECK(ate["interval"]["low"].get<double>() == Approx(0.48));
  CHECK(ate["interval"]["level"].get<double>() == Approx(0.9375));
  CHECK(ate["sign_test_p"].get<double>() == Approx(0.0625));
  // a share that is the same in every run
  CHECK(entry(differences, {{"sequence", "room"}, {"other", "vdb_2cm"}, {"measure", "holdout.coverage"}})["verdict"] ==
        "tie");
  const auto& density =
      entry(differences, {{"sequence", "room"}, {"other", "vdb_2cm"}, {"measure", "holdout.log_density"}});
  CHECK(density["verdict"] == "better");
  CHECK(density["median"].get<double>() == Approx(0.6));
}

TEST_CASE("equal memory and equal error are read off the rivals' front") {
  SuiteFixture suite;
  suite.write();
  const auto json = report_of(suite)["comparisons"][0];
  // 2 MiB is less than the coarsest grid's 4: at least its 40 mm there; and 8 mm finer than the finest one's 20 mm at
  // 45 MiB
  const auto& memory = entry(json["equal_cost"], {{"sequence", "kitchen"}, {"rival", "vdb"}, {"cost", "memory"}});
  CHECK(memory["error_ratio"]["bound"] == "at most");
  CHECK(memory["error_ratio"]["value"].get<double>() == Approx(0.2));
  CHECK(memory["cost_ratio"]["bound"] == "at most");
  CHECK(memory["cost_ratio"]["value"].get<double>() == Approx(2.0 / 45));
  // a variant's sweep is a front of its own: 2 MiB lies in the middle of 1 and 4, in logarithms
  const auto& sweep = entry(json["equal_cost"], {{"sequence", "kitchen"}, {"rival", "fine"}, {"cost", "memory"}});
  CHECK(sweep["rival_error"]["bound"] == "exact");
  CHECK(sweep["rival_error"]["value"].get<double>() == Approx(std::sqrt(7.9 * 8.4)));
  CHECK(json["graphs"][3]["sweep"]["init.size"] == "1 cm");
  const auto& plot = entry(json["plots"], {{"sequence", "kitchen"}, {"title", "Kitchen: error against memory"}});
  REQUIRE(plot["series"].size() == 4);
  CHECK(plot["series"][3]["label"] == "PPM");  // the sweep, by the title that its points share
  CHECK(plot["series"][3]["x"].size() == 2);
  const auto& claims = json["claims"];
  CHECK(claims[0]["holds"] == "no");
  CHECK_THAT(claims[0]["claim"].get<std::string>(), Contains("ATE"));
  CHECK(claims.back()["holds"] == "yes");
}

TEST_CASE("what does not depend on the seed is said to") {
  SuiteFixture suite;
  suite.write();
  const auto json = report_of(suite)["comparisons"][0];
  const auto& measures = entry(json["results"], {{"sequence", "room"}, {"graph", "fine[init.size=1 cm]"}})["measures"];
  CHECK(measures["holdout.median_mm"]["seed_changes_nothing"] == true);
  CHECK(measures["holdout.median_mm"]["interval"].is_null());
  CHECK(measures["times.cpu_ms_mean"]["seed_changes_nothing"] == false);  // times differ all the same
  CHECK_THAT(content(suite.path() / "report.md"), Contains("| 7.90 = |"));
}

TEST_CASE("a run that failed is listed and counts as worse than any other, one that is missing counts nowhere") {
  SuiteFixture suite;
  suite.write();
  for (const int seed : {1, 2, 3}) suite.fail("room", "vdb_2cm", seed, "out of <memory>");
  std::filesystem::remove_all(suite.run("room", "ppm", 5));
  const auto json = report_of(suite)["comparisons"][0];
  const auto& result = entry(json["results"], {{"sequence", "room"}, {"graph", "vdb_2cm"}});
  CHECK(result["runs"]["failed"] == 3);
  CHECK(result["measures"]["trajectory.ate_rmse_m"]["median"].is_null());
  const auto& ate =
      entry(json["differences"], {{"sequence", "room"}, {"other", "vdb_2cm"}, {"measure", "trajectory.ate_rmse_m"}});
  CHECK(ate["differences"].size() == 4);
  CHECK(ate["basis"] == "few seeds");
  CHECK(ate["verdict"] == "tie");  // three failures against one run in which the grid does better
  CHECK_THAT(content(suite.path() / "report.html"),
             Contains("out of &lt;memory&gt;") && Contains("2 done, 3 failed") && Contains("1 to come"));
  CHECK_THAT(content(suite.path() / "runs.csv"), Contains("main,room,vdb_2cm,1,failed"));
}

TEST_CASE("a run that had lost the camera in the end is listed") {
  SuiteFixture suite;
  suite.write();
  const auto file = suite.run("room", "ppm", 2) / "run.json";
  auto run = Json::parse(content(file));
  run["tracking"]["lost_at_end"] = true;
  put(file, run.dump());
  const auto json = report_of(suite)["comparisons"][0];
  CHECK(entry(json["results"], {{"sequence", "room"}, {"graph", "ppm"}})["runs"]["lost_at_end"] == 1);
  CHECK_THAT(content(suite.path() / "report.html"), Contains("5 done, 1 lost"));
  CHECK_THAT(content(suite.path() / "report.md"), Contains("room, PPM, seed 2: lost in the end"));
}

TEST_CASE("without a reference there are no errors, and the rest stands") {
  SuiteFixture suite;
  suite.reference = false;
  suite.seeds = 1;
  suite.write();
  const auto json = report_of(suite)["comparisons"][0];
  CHECK(json["claims"].empty());
  CHECK(json["equal_cost"].empty());
  CHECK(json["plots"].size() == 2 * 2);  // memory and time of both sequences
  const auto& map =
      entry(json["differences"], {{"sequence", "room"}, {"other", "vdb_5cm"}, {"measure", "map.bytes_owned_total"}});
  CHECK(map["verdict"] == "better");
  CHECK(map["basis"] == "one run");
  check_nesting(content(suite.path() / "report.html"));
}

TEST_CASE("pictures of the same frames stand beside each other, small enough for one page") {
  SuiteFixture suite;
  suite.write();
  RgbImage image{1280, 960, {}};
  image.rgb.assign(1280 * 960 * 3, 100);
  for (const char* graph : {"ppm", "vdb_2cm"}) {
    const auto folder = suite.run("kitchen", graph, 1);
    for (const char* name : {"m.png", "p.png", "e.png"}) put(folder / "views" / name, to_png(image));
    put(folder / "views" / "views.json",
        R"([{"frame": 5, "measured": "m.png", "predicted": "p.png", "error": "e.png", "poses": "reference"}])");
  }
  put(suite.run("kitchen", "ppm", 1) / "map.png", to_png(image));
  write_report(suite.path());
  const auto html = content(suite.path() / "report.html");
  check_nesting(html);
  std::size_t pictures = 0;
  for (auto at = html.find("<img"); at != std::string::npos; at = html.find("<img", at + 1)) ++pictures;
  CHECK(pictures == 1 + 2 * 2 + 1);  // measured once; two graphs; a map
  CHECK_THAT(html, Contains("Held-out frame 5") && Contains("OpenVDB 2 cm, error"));
  const RgbImage eighth{160, 120, std::vector<std::uint8_t>(160 * 120 * 3, 100)};
  CHECK_THAT(html, Contains(ppm::report::base64(to_png(in_palette(eighth, 16)))));
  put(suite.run("kitchen", "ppm", 1) / "map.png", "no picture");
  CHECK_THROWS_WITH(write_report(suite.path()), Contains("map.png"));
}

TEST_CASE("pictures are those of the lowest seed that has any") {
  SuiteFixture suite;
  suite.write();
  for (const int seed : {2, 3}) {
    const std::vector<std::uint8_t> rgb(3, static_cast<std::uint8_t>(seed));
    put(suite.run("room", "ppm", seed) / "map.png", to_png(RgbImage{1, 1, rgb}));
  }
  write_report(suite.path());
  const auto html = content(suite.path() / "report.html");
  const auto shows = [&](std::uint8_t gray) {
    const auto png = to_png(in_palette(RgbImage{1, 1, {gray, gray, gray}}, 16));
    return html.find(ppm::report::base64(png)) != std::string::npos;
  };
  CHECK(shows(2));
  CHECK_FALSE(shows(3));
}

TEST_CASE("missing runs are a line a sequence and graph, folded away where they are many, failed ones stand before") {
  SuiteFixture suite;
  suite.write();
  for (const int seed : {1, 3, 4, 5}) std::filesystem::remove_all(suite.run("room", "ppm", seed));
  for (const int seed : {2, 3}) std::filesystem::remove_all(suite.run("kitchen", "vdb_2cm", seed));
  suite.fail("room", "vdb_2cm", 5, "killed");
  write_report(suite.path());
  auto html = content(suite.path() / "report.html");
  CHECK_THAT(html, Contains("<td>Room</td><td>PPM</td><td>seeds 1, 3 to 5</td><td>missing</td>") &&
                       Contains("<td>OpenVDB 2 cm</td><td>seeds 2, 3</td>"));
  CHECK(html.find("killed") < html.find("seeds 2, 3"));
  CHECK(html.find("runs are not done") == std::string::npos);
  CHECK_THAT(content(suite.path() / "report.md"),
             Contains("- room, OpenVDB 2 cm, seed 5: failed killed\n\n"
                      "6 of 50 runs are not done: on kitchen seeds 2, 3 of OpenVDB 2 cm; on room seeds 1, 3 to 5 of "
                      "PPM."));

  suite.graphs.push_back(suite.graphs[0]);
  suite.graphs.back().name = "late";
  suite.write();
  for (const auto& graph : suite.graphs)
    for (const char* sequence : {"kitchen", "room"})
      for (int seed = 2; seed <= 5; ++seed) std::filesystem::remove_all(suite.run(sequence, graph.name, seed));
  write_report(suite.path());
  html = content(suite.path() / "report.html");
  check_nesting(html);
  CHECK_THAT(html,
             Contains("<details><summary>48 of 60 runs are not done: on kitchen seeds 2 to 5 of 6 graphs; on room "
                      "seeds 2 to 5 of 6 graphs.</summary>"));
}

TEST_CASE("of many losses the worst forty are open") {
  SuiteFixture suite;
  auto& subject = suite.graphs[0];
  subject.error_mm = subject.mebibytes = subject.cpu_ms = 500;
  subject.ate_cm = 50;
  suite.write();
  write_report(suite.path());
  const auto html = content(suite.path() / "report.html");
  check_nesting(html);
  const auto open = html.find("<summary>Subject worse: "), rest = html.find(" more</summary>"),
             ties = html.find("No difference found");
  REQUIRE(open < rest);
  REQUIRE(rest < ties);
  const auto rows = [&](std::size_t from, std::size_t to) {
    std::size_t count = 0;
    for (auto at = html.find("<tr class=", from); at < to; at = html.find("<tr class=", at + 1)) ++count;
    return count;
  };
  CHECK(rows(open, rest) == 40);
  CHECK(html.substr(open, 60).find(std::to_string(40 + rows(rest, ties)) + "</summary>") != std::string::npos);
}

TEST_CASE("a subject whose runs failed does not drop out of the summary") {
  SuiteFixture suite;
  suite.write();
  for (const int seed : {1, 2, 3}) suite.fail("room", "ppm", seed, "killed");
  const auto claims = report_of(suite)["comparisons"][0]["claims"];
  CHECK(claims[0]["holds"] == "no");
  CHECK(claims[0]["sequence"] == "room");
  CHECK_THAT(claims[0]["number"].get<std::string>(), Contains("most runs of the subject failed"));
}

TEST_CASE("with known poses there is no error of the path to compare") {
  SuiteFixture suite;
  for (auto& graph : suite.graphs) graph.ate_cm = 1e-7;
  suite.write();
  const auto json = report_of(suite)["comparisons"][0];
  CHECK(json["claims"].size() == 2 * 3);
  for (const auto& plot : json["plots"]) CHECK(plot["y"] != "error after alignment, cm");
  for (const auto& d : json["differences"]) CHECK(d["measure"] != "trajectory.ate_rmse_m");
}

TEST_CASE("what the digits of the tables do not show is a tie") {
  SuiteFixture suite;
  suite.graphs[2].ate_cm = suite.graphs[0].ate_cm + 0.004;
  suite.write();
  const auto differences = report_of(suite)["comparisons"][0]["differences"];
  CHECK(entry(differences,
              {{"sequence", "room"}, {"other", "vdb_2cm"}, {"measure", "trajectory.ate_rmse_m"}})["verdict"] == "tie");
}

TEST_CASE("a suite that has not begun") {
  SuiteFixture suite;
  suite.write();
  std::filesystem::remove_all(suite.path() / "runs");
  const auto json = report_of(suite)["comparisons"][0];
  CHECK(json["differences"].empty());
  CHECK(json["runs"].size() == 50);
  check_nesting(content(suite.path() / "report.html"));
}

TEST_CASE("what is wrong with a folder is said") {
  SuiteFixture suite;
  CHECK_THROWS_WITH(write_report(suite.path()), Contains("suite.json") && Contains("folder of a suite"));
  suite.write();
  put(suite.run("room", "ppm", 2) / "times.csv", "frame,cpu_ms\n0,1\n1,x\n");
  CHECK_THROWS_WITH(write_report(suite.path()), Contains("times.csv:3:1") && Contains("'x'"));
  put(suite.run("room", "ppm", 2) / "job.json", R"({"status": "asleep"})");
  CHECK_THROWS_WITH(write_report(suite.path()), Contains("job.json") && Contains("asleep"));
  put(suite.path() / "suite.json", R"({"name": "x"})");
  CHECK_THROWS_WITH(write_report(suite.path()), Contains("suite.json") && Contains("comparisons"));
}
