// Documents cannot drift: their links lead somewhere, and the module that they show is one that is built and run.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <vector>

namespace fs = std::filesystem;

namespace {

const fs::path kRoot = PPM_SOURCE_DIR;

std::string read(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<fs::path> documents() {
  std::vector<fs::path> found{kRoot / "README.md"};
  for (const auto* folder : {"docs", "third_party_notes"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.path().extension() == ".md") found.push_back(entry.path());
    }
  }
  return found;
}

}  // namespace

TEST_CASE("links in documents lead to files") {
  static const std::regex link(R"(\]\(([^)#:\s]+)(#[^)]*)?\))");
  for (const auto& document : documents()) {
    const auto text = read(document);
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      INFO(document.string() << ": " << (*it)[1]);
      CHECK(fs::exists(document.parent_path() / (*it)[1].str()));
    }
  }
}

TEST_CASE("the module in docs/modules.md is the plug-in that the tests build and run") {
  const auto page = read(kRoot / "docs/modules.md");
  CHECK(page.find("```cpp\n" + read(kRoot / "tests/plugin/drift.cpp") + "```\n") != std::string::npos);
  const auto cmake = read(kRoot / "tests/plugin/CMakeLists.txt");
  CHECK(page.find("```cmake\n" + cmake.substr(cmake.find("cmake_minimum_required")) + "```\n") != std::string::npos);
}
