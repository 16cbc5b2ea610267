// Includes go one way: apps -> {graph, roles}, roles -> {graph, slam}, graph -> {config, slam, core}, config -> core,
// slam -> core, modules -> framework, modules/maps and modules/rawlog; never module -> module.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

struct Include {
  std::string file, line, target;
  bool own;  ///< in quotes
};

const fs::path kRoot = PPM_SOURCE_DIR;

std::vector<Include> includes_of(const std::string& folder) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".cpp" && extension != ".hpp") continue;
    std::ifstream in(entry.path());
    std::smatch match;
    for (std::string line; std::getline(in, line);) {
      if (std::regex_search(line, match, pattern)) {
        found.push_back({fs::relative(entry.path(), kRoot).string(), line, match[2], match[1] == "\""});
      }
    }
  }
  return found;
}

/// "framework/graph" of "framework/graph/node.hpp"; "modules/maps/ppm" of maps.
std::string part_of(const std::string& path) {
  const auto parent = fs::path(path).parent_path().string();
  const auto first = parent.find('/');
  if (first == std::string::npos || parent.starts_with("modules/maps/")) return parent;
  return parent.substr(0, parent.find('/', first + 1));
}

bool allowed(const std::string& from, const std::string& to) {
  static const std::map<std::string, std::set<std::string>> framework{
      {"framework/core", {}},
      {"framework/config", {"framework/core"}},
      {"framework/slam", {"framework/core"}},
      {"framework/graph", {"framework/core", "framework/config", "framework/slam"}},
      {"framework/roles", {"framework/core", "framework/config", "framework/slam", "framework/graph"}}};
  if (from == to) return true;
  if (auto it = framework.find(from); it != framework.end()) return it->second.contains(to);
  if (to.starts_with("framework/")) return true;
  if (from == "apps" && (to == "modules" || to.starts_with("apps/"))) return true;  // the list of built-in modules; a command's parts
  if (from == "apps/compare" && to == "modules") return true;
  if (from.starts_with("modules/maps/")) return from == "modules/maps/export";  // it knows maps and pictures of them
  return to.starts_with("modules/maps/") || to == "modules/rawlog";
}

}  // namespace

TEST_CASE("includes go one way") {
  for (const auto* folder : {"framework", "modules", "apps"}) {
    for (const auto& include : includes_of(folder)) {
      if (!include.own) continue;
      INFO(include.file << ": " << include.line);
      REQUIRE((fs::exists(kRoot / include.target) || include.target == "framework/graph/abi_headers.hpp"));
      CHECK(allowed(part_of(include.file), part_of(include.target)));
    }
  }
}

TEST_CASE("a part of a source file (_inl.hpp) is included by source files alone") {
  for (const auto* folder : {"framework", "modules", "apps", "tests"}) {
    for (const auto& include : includes_of(folder)) {
      INFO(include.file << ": " << include.line);
      CHECK((!include.target.ends_with("_inl.hpp") || include.file.ends_with(".cpp")));
    }
  }
}

TEST_CASE("a module's file is included by nobody") {
  for (const auto* folder : {"framework", "modules", "apps", "tests"}) {
    for (const auto& include : includes_of(folder)) {
      INFO(include.file << ": " << include.line);
      CHECK_FALSE(include.target.ends_with(".cpp"));
    }
  }
}

TEST_CASE("heavy headers of others are included where they are wrapped, and in no header") {
  const std::map<std::string, std::set<std::string>> homes{{"yaml-cpp/", {"framework/config"}},
                                                           {"spdlog/", {"framework/core"}},
                                                           {"tbb/", {"framework/core"}},
                                                           {"oneapi/", {"framework/core"}},
                                                           {"Random123/", {"framework/core"}},
                                                           {"xxhash.h", {"framework/core"}},
                                                           {"nlohmann/", {"framework/graph", "modules/maps/export", "modules/sinks", "apps", "apps/bench", "apps/compare", "apps/report"}},
                                                           {"CLI/", {"apps"}},
                                                           {"embree", {"modules/prediction", "modules/sources"}},
                                                           {"png.h", {"modules/sources", "modules/maps/picture"}},
                                                           {"jpeglib.h", {"modules/sources"}},
                                                           {"OpenMesh/", {"modules/simplify"}},
                                                           {"nanoflann.hpp", {"modules/maps/points"}},
                                                           {"openvdb/", {"modules/maps/export", "modules/maps/vdb"}},
                                                           {"octomap/", {"modules/maps/octomap"}},
                                                           {"open3d/", {"modules/maps/tsdf"}},
                                                           {"dlfcn.h", {"framework/graph", "modules/prediction", "modules/rawlog"}}};
  for (const auto* folder : {"framework", "modules", "apps"}) {
    for (const auto& include : includes_of(folder)) {
      for (const auto& [prefix, folders] : homes) {
        if (include.own || !include.target.starts_with(prefix)) continue;
        INFO(include.file << ": " << include.line);
        CHECK((include.file.ends_with(".cpp") || include.file.ends_with("_inl.hpp")));
        CHECK(folders.contains(part_of(include.file)));
      }
    }
  }
}
