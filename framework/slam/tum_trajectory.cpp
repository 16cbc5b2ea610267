#include "framework/slam/tum_trajectory.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <span>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

constexpr std::string_view kBlank = " \t\r";

/// The numbers of a line, separated by blanks. Returns what is wrong, or "". form: of the line, for messages.
template <std::size_t N>
std::string parse_line(std::string_view line, std::array<double, N>& values, std::string_view form) {
  std::size_t found = 0;
  for (auto start = line.find_first_not_of(kBlank); start != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(kBlank, start), line.size());
    const auto word = line.substr(start, end - start);
    double value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size() || !std::isfinite(value))
      return fmt::format("'{}' is no finite number", word);
    if (found < N) values[found] = value;
    ++found;
    start = line.find_first_not_of(kBlank, end);
  }
  if (found == N) return "";
  return fmt::format("has {} numbers, not the {} of '{}'", found, N, form);
}

/// The pose of seven numbers. Returns what is wrong, or "".
std::string to_pose(std::span<const double, 7> v, Pose& pose) {
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (std::abs(q.norm() - 1) > 1e-2) return fmt::format("the quaternion has norm {:.3g}, not 1", q.norm());
  pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  return "";
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

std::string parse_tum_pose(const std::string& text, Pose& T_map_camera) {
  std::array<double, 7> values{};
  const auto reason = parse_line(text, values, "tx ty tz qx qy qz qw");
  return reason.empty() ? to_pose(values, T_map_camera) : fmt::format("'{}': {}", text, reason);
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
    if (const auto reason = parse_line(line, v, "stamp tx ty tz qx qy qz qw"); !reason.empty()) fail(reason);
    if (!path.empty() && v[0] <= path.back().stamp_s) fail("the stamp is not later than the one before");
    StampedPose p;
    p.frame = static_cast<std::int64_t>(path.size());
    p.stamp_s = v[0];
    if (const auto reason = to_pose(std::span<const double, 7>(v.data() + 1, 7), p.T_map_camera); !reason.empty())
      fail(reason);
    path.push_back(p);
  }
  if (in.bad()) throw DataError(file.string(), "cannot be read");
  if (path.empty()) throw DataError(file.string(), "holds no pose");
  return path;
}

}  // namespace ppm
