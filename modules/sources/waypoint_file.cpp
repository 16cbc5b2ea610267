#include "modules/sources/waypoint_file.hpp"

#include <cmath>
#include <fstream>
#include <string>

#include "framework/core/error.hpp"
#include "modules/sources/number_file.hpp"

namespace ppm {
namespace {

constexpr double kRadian = EIGEN_PI / 180;

class WaypointReader {
 public:
  explicit WaypointReader(const std::filesystem::path& file) : file_(file), in_(file) {
    if (!in_) throw DataError(file.string(), "cannot be opened");
  }
  std::vector<Waypoint> read() {
    for (std::string line; ++line_, std::getline(in_, line);) {
      const auto words = split_words(std::string_view(line).substr(0, line.find('#')));
      if (words.empty()) continue;
      if (words.size() == 1 && words[0] == "jump")
        end_part("a jump");
      else
        take(words);
    }
    end_part("the end");
    return std::move(path_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw DataError(to_string(Place{file_.string(), line_, 1}), reason);
  }
  void end_part(const char* what) {
    if (part_ < 2) fail(fmt::format("{} waypoints before {}; a way needs two", part_, what));
    part_ = 0;
  }
  void take(const std::vector<std::string>& words) {
    if (words.size() != 5 && words.size() != 6) fail("a waypoint has the form 'x y z yaw pitch [seconds]'");
    std::vector<double> v;
    for (const auto& word : words) {
      const auto value = parse_number(word);
      if (!value || !std::isfinite(*value)) fail(fmt::format("'{}' is no finite number", word));
      v.push_back(*value);
    }
    Waypoint w{{v[0], v[1], v[2]}, v[3] * kRadian, v[4] * kRadian, {}, part_ == 0 && !path_.empty()};
    if (v.size() == 6 && !(v[5] > 0)) fail("the seconds since the waypoint before are not positive");
    if (v.size() == 6) w.seconds = v[5];
    path_.push_back(w);
    ++part_;
  }

  const std::filesystem::path& file_;
  std::ifstream in_;
  int line_ = 0;
  std::size_t part_ = 0;  // waypoints since the last jump
  std::vector<Waypoint> path_;
};

}  // namespace

std::vector<Waypoint> read_waypoints(const std::filesystem::path& file) {
  return WaypointReader(file).read();
}

}  // namespace ppm
