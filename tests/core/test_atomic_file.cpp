#include <catch2/catch.hpp>
#include <fstream>
#include <signal.h>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>

#include "framework/core/atomic_file.hpp"
#include "framework/core/error.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using Catch::Matchers::Contains;

namespace {

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// No file of this process may grow beyond `bytes` while this lives: what a full disk looks like to write().
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

}  // namespace

TEST_CASE("a committed file holds exactly what was written, and nothing else is left") {
  test::TempFolder folder;
  std::string expected;
  {
    AtomicFile file(folder / "a.bin");
    for (int i = 0; i < 40000; ++i) {  // crosses the buffer's size
      const std::string piece = std::to_string(i) + std::string(1, '\0') + std::string(50, 'x');
      file.write(piece);
      expected += piece;
    }
    CHECK_FALSE(std::filesystem::exists(folder / "a.bin"));
    file.commit();
  }
  CHECK(content(folder / "a.bin") == expected);
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a file that is dropped leaves nothing, and the one that was there stays") {
  test::TempFolder folder;
  { AtomicFile(folder / "new.txt").write("half"); }
  CHECK(entries(folder.path()) == 0);

  write_file(folder / "old.txt", "old");
  { AtomicFile(folder / "old.txt").write("half"); }
  CHECK(content(folder / "old.txt") == "old");
  write_file(folder / "old.txt", "new");
  CHECK(content(folder / "old.txt") == "new");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("an exception while a file is being written leaves nothing") {
  test::TempFolder folder;
  try {
    AtomicFile file(folder / "a.txt");
    file.write("half");
    throw DataError("x", "y");
  } catch (const DataError&) {}
  CHECK(entries(folder.path()) == 0);
}

TEST_CASE("a disk without room: the error names the file and the system's reason, nothing is left") {
  test::TempFolder folder;
  {
    FileSizeLimit limit(100'000);
    auto write = [&] {
      AtomicFile file(folder / "big.bin");
      for (int i = 0; i < 100; ++i) file.write(std::string(50'000, 'x'));
      file.commit();
    };
    CHECK_THROWS_AS(write(), OutputError);
    CHECK_THROWS_WITH(write(), Contains("big.bin") && Contains("File too large"));
    // smaller than the buffer: only commit() meets the limit
    CHECK_THROWS_AS(write_file(folder / "big.bin", std::string(150'000, 'x')), OutputError);
  }
  CHECK(entries(folder.path()) == 0);
}

TEST_CASE("a folder that is missing, a file in its place, a folder in the file's place") {
  test::TempFolder folder;
  CHECK_THROWS_WITH(write_file(folder / "no/a.txt", "x"),
                    Contains("no/a.txt") && Contains("No such file or directory"));
  write_file(folder / "file", "x");
  CHECK_THROWS_WITH(write_file(folder / "file/a.txt", "x"), Contains("Not a directory"));
  std::filesystem::create_directory(folder / "sub");
  CHECK_THROWS_WITH(write_file(folder / "sub", "x"), Contains("sub") && Contains("Is a directory"));
  CHECK(entries(folder / "sub") == 0);
}

TEST_CASE("a folder without permission") {
  if (::geteuid() == 0) {
    WARN("root may write everywhere: not tested");
    return;
  }
  test::TempFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  CHECK_THROWS_WITH(write_file(folder / "a.txt", "x"), Contains("Permission denied"));
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST_CASE("writing to a committed file is our own bug") {
  test::TempFolder folder;
  AtomicFile file(folder / "a.txt");
  file.commit();
  CHECK_THROWS_AS(file.write("x"), InternalError);
  CHECK_THROWS_AS(file.commit(), InternalError);
}
