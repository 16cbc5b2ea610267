// What cannot go on says why.
#include "framework/core/record_file.hpp"
#include "tests/apps/resumed.hpp"
#include "tests/support/data.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// A small run of six frames with a checkpoint of the fourth.
struct Stopped : SmallRoom {
  std::string folder_name = out.string();
  Stopped() { REQUIRE(run({"--frames", "6", "--checkpoint-every", "4", "--quiet"})->code == 0); }
  fs::path checkpoint() const { return out / "run.checkpoint"; }

  /// The refusal of a resume: exit code 2 and nothing written.
  std::string refusal() const {
    const auto report = content(out / "run.json");
    const auto resumed = ppm_command({"run", "--resume", folder_name});
    CHECK(resumed->code == 2);
    CHECK(content(out / "run.json") == report);
    return resumed->err;
  }
};

void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
  auto text = content(file);
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  std::ofstream(file, std::ios::binary) << text;
}

/// Writes the header of a checkpoint anew, with a change and the checksum that fits it.
void change_header(const fs::path& file, const std::function<void(std::string&)>& change) {
  const auto bytes = content(file);
  std::uint64_t length = 0;
  std::copy_n(bytes.data() + 8, sizeof length, reinterpret_cast<char*>(&length));
  auto header = bytes.substr(16, length);
  change(header);
  {
    ppm::RecordFileWriter out(file, bytes.substr(0, 8));
    ppm::RecordWriter record;
    for (char c : header) record.add(c);
    out.write(record);
    out.commit();
  }
  std::ofstream(file, std::ios::binary | std::ios::app) << bytes.substr(16 + length + 32);
}

}  // namespace

TEST_CASE("a folder without a checkpoint, or that is none, cannot go on") {
  Stopped room;
  CHECK(ppm_command({"run", "--resume", room.folder_name, "--quiet"})->code == 0);
  fs::remove(room.checkpoint());
  CHECK_THAT(room.refusal(),
             Contains("--resume " + room.folder_name) && Contains("no checkpoint") && Contains("--checkpoint-every"));
  CHECK_THAT(ppm_command({"run", "--resume", (room.folder / "no_such").string()})->err, Contains("no checkpoint"));
}

TEST_CASE("a graph that was changed is refused with the difference") {
  Stopped room;
  replace_in(room.out / "config.effective.yaml", "sigma_t: 0.004", "sigma_t: 0.005");
  CHECK_THAT(room.refusal(), Contains("config.effective.yaml: the graph is not the one that the checkpoint is of") &&
                                 Contains("'sigma_t: 0.005' here, 'sigma_t: 0.004' there"));
  fs::remove(room.out / "config.effective.yaml");
  CHECK_THAT(room.refusal(), Contains("config.effective.yaml"));
}

TEST_CASE("a checkpoint that is cut or altered is refused with the place") {
  Stopped room;
  const auto bytes = content(room.checkpoint());
  auto write = [&](const std::string& other) { std::ofstream(room.checkpoint(), std::ios::binary) << other; };
  for (double share : {0.0001, 0.3, 0.6, 0.9999}) {
    INFO(share);
    const auto length = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
    write(bytes.substr(0, length));
    CHECK_THAT(room.refusal(), Contains("run.checkpoint: is cut short"));
    auto altered = bytes;
    char& byte = altered[std::min(length + 10, altered.size() - 1)];
    byte = static_cast<char>(byte ^ 1);
    write(altered);
    CHECK_THAT(room.refusal(), Contains("run.checkpoint: ") && (Contains("was altered") || Contains("is cut short")));
  }
  write(bytes + "x");
  CHECK_THAT(room.refusal(), Contains("goes on after the maps"));
  write("what is this");
  CHECK_THAT(room.refusal(), Contains("is not a checkpoint"));
  write(bytes);
  CHECK(ppm_command({"run", "--resume", room.folder_name, "--quiet"})->code == 0);
}

TEST_CASE("a checkpoint of another version, or of another build of ppm, is refused") {
  Stopped room;
  const auto bytes = content(room.checkpoint());
  change_header(room.checkpoint(), [](std::string& header) { header[0] = 9; });
  CHECK_THAT(room.refusal(), Contains("the header is of version 9; this program reads version 1"));
  std::ofstream(room.checkpoint(), std::ios::binary) << bytes;
  change_header(room.checkpoint(), [](std::string& header) { header.replace(header.find("ppm 0."), 5, "ppm 7"); });
  CHECK_THAT(room.refusal(), Contains("was written by another build of ppm") && Contains("checkpoint: ppm 7"));
}

TEST_CASE("what --resume takes from the folder cannot be given beside it") {
  Stopped room;
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{room.graph},
                                                                                    {"--seed", "3"},
                                                                                    {"--set", "init.particles=2"},
                                                                                    {"--out", "x"},
                                                                                    {"--force"},
                                                                                    {"--plugin", "x.so"}}) {
    std::vector<std::string> arguments{"run", "--resume", room.folder_name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto run = ppm_command(arguments);
    INFO(more[0]);
    CHECK(run->code == 2);
    CHECK_THAT(run->err, Contains("--resume") && Contains("excludes"));
  }
  const auto nothing = ppm_command({"run"});
  CHECK(nothing->code == 2);
  CHECK_THAT(nothing->err, Contains("name a graph file, or with --resume"));
}

TEST_CASE("a run whose data is gone, or has changed, cannot go on") {
  const auto data = data_path("kitchen");
  if (!data) return;
  TempFolder folder;
  const auto link = folder / "images", out = folder / "run";
  fs::create_directory_symlink(*data, link);
  const std::string graph = std::string(PPM_SOURCE_DIR) + "/configs/kitchen_mapping.yaml";
  REQUIRE(ppm_command({"run", graph, "--set", "camera.path=" + link.string(), "--out", out.string(), "--frames", "3",
                       "--checkpoint-every", "2", "--quiet"})
              ->code == 0);
  fs::remove(link);
  const auto gone = ppm_command({"run", "--resume", out.string()});
  CHECK(gone->code == 2);
  CHECK_THAT(gone->err, Contains(link.string()) && Contains("there is no such folder"));

  fs::create_directory(link);
  for (const auto& entry : fs::directory_iterator(*data))
    if (entry.path().filename().string() < "frame-000010")
      fs::create_symlink(entry.path(), link / entry.path().filename());
  const auto fewer = ppm_command({"run", "--resume", out.string()});
  CHECK(fewer->code == 2);
  CHECK_THAT(fewer->err, Contains("has changed: it had") && Contains("node 'camera'"));
}
