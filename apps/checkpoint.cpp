#include "apps/checkpoint.hpp"

#include <sstream>

#include "apps/run_folder.hpp"
#include "framework/core/error.hpp"
#include "framework/graph/abi.hpp"

// A file of records (see record_file.hpp). First record: version, build of ppm, RunStart. Then what Executor::save writes.

namespace ppm {

namespace {

constexpr std::string_view kMagic = "PPMRUN\r\n";
constexpr std::uint32_t kVersion = 1;

std::filesystem::path checkpoint_of(const std::filesystem::path& run) {
  const auto file = run / kCheckpoint;
  if (!std::filesystem::exists(file))
    throw ConfigError(Place{"--resume " + run.string()},
                      fmt::format("no checkpoint '{}' there: a run leaves one with --checkpoint-every N, or on Ctrl-C", kCheckpoint));
  return file;
}

/// The first line in which two texts differ, of each.
std::pair<std::string, std::string> first_difference(const std::string& a, const std::string& b) {
  std::istringstream in_a(a), in_b(b);
  std::string line_a, line_b;
  while (true) {
    const bool more_a = static_cast<bool>(std::getline(in_a, line_a));
    const bool more_b = static_cast<bool>(std::getline(in_b, line_b));
    if (!more_a) line_a = "its end";
    if (!more_b) line_b = "its end";
    if (!more_a || !more_b || line_a != line_b) break;
  }
  auto trimmed = [](const std::string& line) { return line.substr(std::min(line.find_first_not_of(" -"), line.size())); };
  return {trimmed(line_a), trimmed(line_b)};
}

RunStart read_start(RecordFileReader& file) {
  auto in = file.next("the header");
  const auto version = in.take<std::uint32_t>();
  if (version != kVersion) in.fail(fmt::format("is of version {}; this program reads version {}", version, kVersion));
  const auto build = in.take<std::string>();
  if (build != PPM_ABI_STAMP)
    throw DataError(file.file(), fmt::format("was written by another build of ppm: finish the run with that one\n  checkpoint: {}\n"
                                             "  this ppm:   {}",
                                             build, PPM_ABI_STAMP));
  RunStart start;
  in.take(start.experiment);
  start.graph_file = in.take<std::string>();
  in.take(start.max_frames);
  in.take(start.files);
  in.finish();
  return start;
}

}  // namespace

std::uint64_t write_checkpoint(const std::filesystem::path& file, const RunStart& start, const Executor& executor) {
  RecordFileWriter out(file, kMagic);
  RecordWriter header;
  header.add(kVersion);
  header.add(std::string(PPM_ABI_STAMP));
  header.add(start.experiment);
  header.add(start.graph_file.string());
  header.add(start.max_frames);
  header.add(start.files);
  out.write(header);
  executor.save(out);
  out.commit();
  return out.bytes();
}

Checkpoint::Checkpoint(const std::filesystem::path& run)
    : file_(checkpoint_of(run), kMagic, "a checkpoint"), start_(read_start(file_)) {}

void Checkpoint::check_graph(const Graph& graph, const std::filesystem::path& file) const {
  const auto now = graph.experiment_yaml();
  if (now == start_.experiment) return;
  const auto [here, there] = first_difference(now, start_.experiment);
  throw ConfigError(Place{file.string()},
                    fmt::format("the graph is not the one that the checkpoint is of: '{}' here, '{}' there", here, there));
}

void Checkpoint::restore(Executor& executor) {
  executor.load(file_);
  file_.finish("the maps");
}

}  // namespace ppm
