// What holds for every module that is built in or ships as a plug-in.
#include <catch2/catch.hpp>
#include <regex>
#include <set>

#include "framework/graph/describe.hpp"
#include "framework/graph/facet_state.hpp"
#include "framework/graph/harness.hpp"
#include "tests/support/shipped_plugins.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;

namespace {

const std::set<std::string> kCategories{"source",    "sensor",     "preprocess", "map",        "motion",   "prediction",
                                        "weighting", "recovery",  "resampling", "map_update", "refinement", "simplify",   "sink"};
const std::set<std::string> kFacets{"belief",    "prediction",  "prediction.elements", "fit",      "motion.prior", "map.octomap",
                                    "map.points", "map.ppm",     "map.tsdf",            "map.vdb",  "map.*"};
const std::regex kLowerSnake("[a-z][a-z0-9_]*");

void check_each(const std::function<void(const ModuleInfo&, Module&)>& check) {
  for (const auto* info : test::shipped().all()) {
    INFO(info->name);
    auto module = info->make();
    check(*info, *module);
  }
}

bool is_sentence(const std::string& text) {
  return text.size() > 1 && text.back() == '.' && !std::islower(static_cast<unsigned char>(text.front()));
}

}  // namespace

TEST_CASE("contract: modules of every stage of the filter are built in") {
  std::set<std::string> categories;
  check_each([&](const ModuleInfo& info, Module&) { categories.insert(info.name.substr(0, info.name.find('.'))); });
  for (const auto& name : {"source", "map", "motion", "prediction", "weighting", "resampling", "map_update", "sink"}) {
    INFO(name);
    CHECK(categories.contains(name));
  }
}

TEST_CASE("contract: a module says what it is and where it is from") {
  check_each([](const ModuleInfo& info, Module&) {
    CHECK(kCategories.contains(info.name.substr(0, info.name.find('.'))));
    CHECK(is_sentence(info.summary));
    CHECK(info.summary.find(". ") == std::string::npos);  // one sentence
    CHECK_FALSE(info.source.empty());
    CHECK((info.origin == "built in" || info.origin.find("/ppm/plugins/") != std::string::npos));
  });
}

TEST_CASE("contract: every parameter is documented, and its default is allowed") {
  check_each([](const ModuleInfo& info, Module& module) {
    Diagnostics mistakes;
    const Config defaults = module.params().effective();
    Config values = Config::map({});
    for (const auto& spec : module.params().specs()) {
      INFO(spec.name());
      CHECK(std::regex_match(spec.name(), kLowerSnake));
      CHECK(is_sentence(spec.doc()));
      if (spec.is_required()) {
        CHECK(spec.default_text().empty());
      } else {
        values.set(spec.name(), {}, *defaults.find(spec.name()));
      }
    }
    info.make()->params().parse(&values, info.name, {}, mistakes);
    for (const auto& m : mistakes) {
      INFO(m.message);
      CHECK(m.message.find("needs the parameter") != std::string::npos);
    }
  });
}

TEST_CASE("contract: every port is documented, and names differ") {
  check_each([](const ModuleInfo&, Module& module) {
    std::set<std::pair<PortDirection, std::string>> names;
    CHECK_FALSE(module.ports().empty());
    for (const auto* port : module.ports()) {
      INFO(port->name());
      CHECK(std::regex_match(port->name(), kLowerSnake));
      CHECK(is_sentence(port->doc()));
      CHECK_FALSE(port->type_name().empty());
      CHECK(names.emplace(port->direction(), port->name()).second);
    }
  });
}

TEST_CASE("contract: facets are known words") {
  check_each([](const ModuleInfo&, Module& module) {
    const auto facets = facets_of(module);
    for (const auto& list : {facets.needs, facets.gives, facets.drops}) {
      for (const auto& facet : list) {
        INFO(facet);
        CHECK(kFacets.contains(facet));
      }
    }
  });
}

TEST_CASE("contract: a module is described in every form") {
  const auto schema = graph_schema(test::shipped());
  check_each([&](const ModuleInfo& info, Module& module) {
    const auto text = describe_text(info);
    const auto page = describe_markdown(info);
    CHECK(text.starts_with(info.name + "\n"));
    CHECK(schema.find("\"" + info.name + "\"") != std::string::npos);
    for (const auto& spec : module.params().specs()) {
      CHECK(text.find(spec.name()) != std::string::npos);
      CHECK(page.find("`" + spec.name() + "`") != std::string::npos);
    }
  });
}

TEST_CASE("contract: a module made and dropped leaves nothing, opened with defaults it works or says why not") {
  test::TempFolder folder;
  check_each([&](const ModuleInfo& info, Module&) {
    try {
      Harness harness(test::shipped(), info.name, "{}", 1, 1, folder.path());
      CHECK(std::filesystem::is_empty(folder.path()));
      harness.module().open(harness.context());
    } catch (const ConfigError&) {  // a required parameter
    } catch (const DataError&) {    // no such data
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) std::filesystem::remove_all(entry);
  });
}
