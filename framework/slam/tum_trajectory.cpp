#include "framework/slam/tum_trajectory.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

constexpr std::string_view kBlank = " \t\r";

/// The numbers of a line, separated by blanks. Returns what is wrong, or "".
std::string parse_line(std::string_view line, std::array<double, 8>& values) {
  std::size_t found = 0;
  for (auto start = line.find_first_not_of(kBlank); start != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(kBlank, start), line.size());
    const auto word = line.substr(start, end - start);
    double value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size() || !std::isfinite(value))
      return fmt::format("'{}' is no finite number", word);
    if (found < values.size()) values[found] = value;
    ++found;
    start = line.find_first_not_of(kBlank, end);
  }
  if (found == values.size()) return "";
  return fmt::format("has {} numbers, not the 8 of 'stamp tx ty tz qx qy qz qw'", found);
}

}  // namespace

std::string to_tum(const std::vector<StampedPose>& path) {
  std::string text;
  for (const auto& p : path) {
    const Eigen::Vector3d t = p.T_map_camera.translation();
    const Eigen::Quaterniond q(p.T_map_camera.linear());
    fmt::format_to(std::back_inserter(text), "{:.6f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", p.stamp_s,
                   t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

std::vector<StampedPose> read_tum(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw DataError(file.string(), "cannot be opened");
  std::vector<StampedPose> path;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto text = line.find_first_not_of(kBlank);
    if (text == std::string::npos || line[text] == '#') continue;
    auto fail = [&](const std::string& reason) { throw DataError(to_string(Place{file.string(), number, 1}), reason); };
    std::array<double, 8> v{};
    if (const auto reason = parse_line(line, v); !reason.empty()) fail(reason);
    if (!path.empty() && v[0] <= path.back().stamp_s) fail("the stamp is not later than the one before");
    Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
    if (std::abs(q.norm() - 1) > 1e-2) fail(fmt::format("the quaternion has norm {:.3g}, not 1", q.norm()));
    StampedPose p;
    p.frame = static_cast<std::int64_t>(path.size());
    p.stamp_s = v[0];
    p.T_map_camera.linear() = q.normalized().toRotationMatrix();
    p.T_map_camera.translation() = Eigen::Vector3d(v[1], v[2], v[3]);
    path.push_back(p);
  }
  if (in.bad()) throw DataError(file.string(), "cannot be read");
  if (path.empty()) throw DataError(file.string(), "holds no pose");
  return path;
}

}  // namespace ppm
