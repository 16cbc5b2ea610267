#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ppm {

constexpr const char* kEffectiveGraph = "config.effective.yaml";
constexpr const char* kCheckpoint = "run.checkpoint";
constexpr const char* kViews = "views";  ///< a folder in it, for pictures

/// The folder that a run writes to. It may be new, empty, or of an earlier run, whose results this one replaces.
class RunFolder {
 public:
  /// Makes the folder. Throws ConfigError where it is a file, or holds other things than a run and `force` is not set;
  /// OutputError where it cannot be made.
  RunFolder(std::filesystem::path path, bool force);
  /// The folder of a run that goes on, which had written these files.
  RunFolder(std::filesystem::path path, const std::vector<std::string>& written);
  /// Removes the folder if it was made here and is empty: a run that failed leaves nothing.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Removes what the earlier run left and this one has not written yet. For when the first frame is
  /// done: a run whose input cannot be read leaves the earlier results alone.
  void drop_earlier_results();
  /// Names of the files that this run has written, in alphabetical order, those of pictures with their folder.
  std::vector<std::string> written() const;

 private:
  using Times = std::map<std::string, std::filesystem::file_time_type>;
  std::filesystem::path path_;
  bool made_ = false;
  Times before_;                      // files that were there
  std::vector<std::string> earlier_;  // those of the earlier run; some may not be there
};

}  // namespace ppm
