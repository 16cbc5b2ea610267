#include "modules/sources/tum_list.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <sstream>

#include "framework/core/error.hpp"
#include "modules/sources/file_bytes.hpp"
#include "modules/sources/number_file.hpp"

namespace ppm {
namespace {

namespace fs = std::filesystem;

struct StampedFile {
  double stamp_s;
  fs::path file;
};

/// The lines of a list that are no comments, as words. Throws DataError where a line has fewer than `least` words.
class ListFile {
 public:
  ListFile(fs::path file, std::size_t least) : file_(std::move(file)) {
    std::istringstream in(read_bytes(file_));
    int number = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      auto words = split_words(line);
      if (words.empty() || words[0].starts_with('#')) continue;
      lines_.push_back({number, std::move(words)});
      if (lines_.back().words.size() < least)
        fail(lines_.size() - 1, fmt::format("a line must have {} columns", least));
    }
  }
  std::size_t size() const { return lines_.size(); }
  const std::string& word(std::size_t line, std::size_t column) const { return lines_[line].words[column]; }
  double stamp(std::size_t line, std::size_t column) const {
    const auto stamp = parse_number(word(line, column));
    if (!stamp || !std::isfinite(*stamp)) fail(line, fmt::format("'{}' is not a time stamp", word(line, column)));
    return *stamp;
  }
  [[noreturn]] void fail(std::size_t line, const std::string& why) const {
    throw DataError(fmt::format("{}:{}", file_.string(), lines_[line].number), why);
  }
  const fs::path& file() const { return file_; }

 private:
  struct Line {
    int number;
    std::vector<std::string> words;
  };
  fs::path file_;
  std::vector<Line> lines_;
};

void check_ascending(const ListFile& list, std::size_t line, double before, double stamp) {
  if (line > 0 && !(stamp > before))
    list.fail(line, fmt::format("the stamp {} is not later than {} of the line before", stamp, before));
}

std::vector<TumImage> read_associations(const fs::path& folder) {
  const ListFile list(folder / "associations.txt", 4);
  std::vector<TumImage> images;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto is_depth = [&](std::size_t column) { return list.word(i, column).find("depth") != std::string::npos; };
    if (is_depth(1) == is_depth(3)) list.fail(i, "one of the two files, and one only, must have 'depth' in its path");
    const std::size_t depth = is_depth(1) ? 0 : 2, color = 2 - depth;
    images.push_back({list.stamp(i, depth), folder / list.word(i, depth + 1), folder / list.word(i, color + 1)});
    check_ascending(list, i, i > 0 ? images[i - 1].stamp_s : 0, images[i].stamp_s);
  }
  return images;
}

std::vector<StampedFile> read_list(const fs::path& file, const fs::path& folder) {
  const ListFile list(file, 2);
  std::vector<StampedFile> files;
  for (std::size_t i = 0; i < list.size(); ++i) {
    files.push_back({list.stamp(i, 0), folder / list.word(i, 1)});
    check_ascending(list, i, i > 0 ? files[i - 1].stamp_s : 0, files[i].stamp_s);
  }
  return files;
}

/// The file nearest in time, empty where none is near enough. files: ascending.
fs::path nearest(const std::vector<StampedFile>& files, double stamp_s, double max_dt_s) {
  auto after = std::lower_bound(files.begin(), files.end(), stamp_s,
                                [](const StampedFile& f, double s) { return f.stamp_s < s; });
  if (after == files.end() || (after != files.begin() && stamp_s - (after - 1)->stamp_s <= after->stamp_s - stamp_s)) {
    if (after == files.begin()) return {};
    --after;
  }
  return std::abs(after->stamp_s - stamp_s) <= max_dt_s ? after->file : fs::path();
}

std::vector<TumImage> associate(const fs::path& folder, double max_dt_s) {
  std::vector<StampedFile> colors;
  if (fs::exists(folder / "rgb.txt")) colors = read_list(folder / "rgb.txt", folder);
  std::vector<TumImage> images;
  for (const auto& depth : read_list(folder / "depth.txt", folder))
    images.push_back({depth.stamp_s, depth.file, nearest(colors, depth.stamp_s, max_dt_s)});
  return images;
}

}  // namespace

std::vector<TumImage> list_tum_images(const fs::path& folder, double max_dt_s, std::vector<std::string>& remarks) {
  const bool paired = fs::exists(folder / "associations.txt");
  if (!paired && !fs::exists(folder / "depth.txt"))
    throw DataError(folder.string(), "has neither associations.txt nor depth.txt");
  std::vector<TumImage> images = paired ? read_associations(folder) : associate(folder, max_dt_s);
  const fs::path list = folder / (paired ? "associations.txt" : "depth.txt");

  const auto there = [](const TumImage& image) { return fs::exists(image.depth); };
  const auto first = std::find_if(images.begin(), images.end(), there);
  if (first == images.end())
    throw DataError(list.string(), images.empty() ? "lists no images" : "none of the images that it lists is there");
  const auto end = std::find_if(images.rbegin(), images.rend(), there).base();
  if (end - first < static_cast<std::ptrdiff_t>(images.size()))
    remarks.push_back(fmt::format("{} lists {} images; only {} to {} are there", list.filename().string(),
                                  images.size(), first->depth.filename().string(),
                                  (end - 1)->depth.filename().string()));
  return {first, end};
}

}  // namespace ppm
