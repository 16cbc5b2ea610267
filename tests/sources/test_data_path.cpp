#include <catch2/catch.hpp>
#include <stdlib.h>

#include "framework/core/error.hpp"
#include "modules/sources/data_path.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;

namespace {

/// PPM_DATA with another value, or without one (null), until the end of the scope.
class DataVariable {
 public:
  explicit DataVariable(const char* value) {
    if (const char* old = std::getenv("PPM_DATA")) old_ = old, had_ = true;
    set(value);
  }
  ~DataVariable() { set(had_ ? old_.c_str() : nullptr); }

 private:
  static void set(const char* value) { value ? ::setenv("PPM_DATA", value, 1) : ::unsetenv("PPM_DATA"); }
  std::string old_;
  bool had_ = false;
};

}  // namespace

TEST_CASE("${PPM_DATA} at the beginning of a path is replaced") {
  {
    const DataVariable variable("/data/sets");
    CHECK(expand_data_path("${PPM_DATA}/kitchen") == "/data/sets/kitchen");
    CHECK(expand_data_path("kitchen") == "kitchen");
  }
  {
    const DataVariable variable(nullptr);
    CHECK(expand_data_path("${PPM_DATA}/kitchen") == "../shared/data/kitchen");
  }
  {
    const DataVariable variable("");
    CHECK(expand_data_path("${PPM_DATA}") == "../shared/data");
  }
}

TEST_CASE("a '$' in the variable's own value is no variable") {
  const DataVariable variable("/odd$place");
  CHECK(expand_data_path("${PPM_DATA}/kitchen") == "/odd$place/kitchen");
}

TEST_CASE("other variables are refused") {
  const std::string reason = ": only ${PPM_DATA}, at the beginning, is replaced in a path";
  CHECK_THROWS_WITH(expand_data_path("${HOME}/kitchen"), "${HOME}/kitchen" + reason);
  CHECK_THROWS_WITH(expand_data_path("data/${PPM_DATA}"), "data/${PPM_DATA}" + reason);
}

TEST_CASE("a folder that is not there is named as it was looked for") {
  const test::TempFolder folder;
  const DataVariable variable(folder.path().c_str());
  CHECK(data_folder("${PPM_DATA}") == folder.path());
  CHECK_THROWS_WITH(data_folder("${PPM_DATA}/none"), (folder / "none").string() +
                                                         ": there is no such folder (the environment "
                                                         "variable PPM_DATA says where data is)");
  CHECK_THROWS_WITH(data_folder(folder / "none"), (folder / "none").string() + ": there is no such folder");
}
