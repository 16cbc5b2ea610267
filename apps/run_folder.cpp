#include "apps/run_folder.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

constexpr const char* kReport = "run.json";

/// Of the files in a run's folder and in its one folder for pictures, by name within the former.
std::map<std::string, std::filesystem::file_time_type> file_times(const std::filesystem::path& folder) {
  std::map<std::string, std::filesystem::file_time_type> times;
  for (const auto& part : {folder, folder / kViews}) {
    if (!std::filesystem::is_directory(part)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(part))
      if (entry.is_regular_file())
        times[entry.path().lexically_relative(folder).generic_string()] = entry.last_write_time();
  }
  return times;
}

/// Of a file in the folder or in its one for pictures, never a way out.
bool is_inside(const std::string& name) {
  const std::filesystem::path path(name);
  return path.filename() == name || std::filesystem::path(kViews) / path.filename() == path;
}

/// What an earlier run left: the files that its run.json lists, and those that every run has. A run that was killed has no list.
std::vector<std::string> files_of_run(const std::filesystem::path& folder) {
  std::vector<std::string> files{kReport, kEffectiveGraph, kCheckpoint};
  std::ifstream in(folder / kReport);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object() || !json.contains("files") || !json["files"].is_array()) return files;
  for (const auto& name : json["files"]) {
    if (name.is_string() && is_inside(name.get<std::string>())) files.push_back(name.get<std::string>());
  }
  return files;
}

}  // namespace

RunFolder::RunFolder(std::filesystem::path path, bool force) : path_(std::move(path)) {
  namespace fs = std::filesystem;
  if (fs::exists(path_) && !fs::is_directory(path_))
    throw ConfigError(Place{"--out " + path_.string()}, "this is a file, not a folder");
  std::error_code error;
  made_ = fs::create_directories(path_, error);
  if (error) throw OutputError(fmt::format("cannot make the folder {}: {}", path_.string(), error.message()));
  before_ = file_times(path_);
  const bool is_run = before_.contains(kReport) || before_.contains(kEffectiveGraph);
  if (is_run) earlier_ = files_of_run(path_);
  if (!is_run && !force && !fs::is_empty(path_))
    throw ConfigError(Place{"--out " + path_.string()},
                      "the folder holds other things than a run; --force writes into it all the same");
}

RunFolder::RunFolder(std::filesystem::path path, const std::vector<std::string>& written)
    : path_(std::move(path)), before_(file_times(path_)) {
  for (const auto& name : written) before_.erase(name);
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  if (made_ && std::filesystem::is_empty(path_, ignored)) std::filesystem::remove(path_, ignored);
}

void RunFolder::drop_earlier_results() {
  const auto now = file_times(path_);
  for (const auto& name : earlier_) {
    const auto file = now.find(name);
    if (file != now.end() && file->second == before_[name]) std::filesystem::remove(path_ / name);
  }
  earlier_.clear();
  std::error_code not_empty;
  std::filesystem::remove(path_ / kViews, not_empty);
}

std::vector<std::string> RunFolder::written() const {
  std::vector<std::string> names;
  for (const auto& [name, time] : file_times(path_)) {
    const auto old = before_.find(name);
    if (old == before_.end() || old->second != time) names.push_back(name);
  }
  return names;
}

}  // namespace ppm
