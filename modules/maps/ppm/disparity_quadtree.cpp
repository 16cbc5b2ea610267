#include "modules/maps/ppm/disparity_quadtree.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

namespace ppm {
namespace {

float smoothed(const DisparityImage& raw, int x, int y, int radius, float pair_sigmas) {
  const float centre = raw.value[raw.at(x, y)], limit = pair_sigmas * raw.sigma[raw.at(x, y)];
  float sum = centre, weight = 1;
  for (int v = 0; v <= radius; ++v)
    for (int u = v == 0 ? 1 : -radius; u <= radius; ++u) {
      if (!raw.inside(x + u, y + v) || !raw.inside(x - u, y - v)) continue;
      const float d1 = raw.value[raw.at(x + u, y + v)], d2 = raw.value[raw.at(x - u, y - v)];
      if (!(std::abs(0.5f * (d1 + d2) - centre) <= limit) || std::abs(d1 - d2) > 6 * limit) continue;
      sum += d1 + d2;
      weight += 2;
    }
  return sum / weight;
}

/// The least-squares plane of a square's measured pixels, where the square is flat.
std::optional<Leaf> fit(const DisparityImage& image, int x, int y, int size, const QuadtreeSettings& settings) {
  const int x1 = std::min(x + size, image.cols - 1), y1 = std::min(y + size, image.rows - 1);
  Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
  Eigen::Vector3f right = Eigen::Vector3f::Zero();
  for (int v = y; v <= y1; ++v)
    for (int u = x; u <= x1; ++u) {
      const float d = image.value[image.at(u, v)];
      if (d != d) continue;
      const Eigen::Vector3f j(static_cast<float>(u - x), static_cast<float>(v - y), 1.0f);
      normal += j * j.transpose();
      right += j * d;
    }
  const float measured = normal(2, 2), pixels = static_cast<float>((x1 - x + 1) * (y1 - y + 1));
  if (measured < settings.valid_share * pixels || measured < 3) return std::nullopt;
  if (normal.determinant() < 1e-3f) return std::nullopt;
  const Eigen::Vector3f plane = normal.inverse() * right;
  const Leaf leaf{x, y, size, plane.x(), plane.y(), plane.z()};
  float squares = 0;
  const float peak = settings.peak_factor * settings.rms_sigmas;
  for (int v = y; v <= y1; ++v)
    for (int u = x; u <= x1; ++u) {
      const auto p = image.at(u, v);
      if (image.value[p] != image.value[p]) continue;
      const float r = (image.value[p] - leaf.disparity(u, v)) / image.sigma[p];
      if (std::abs(r) > peak) return std::nullopt;
      squares += r * r;
    }
  if (squares > settings.rms_sigmas * settings.rms_sigmas * measured) return std::nullopt;
  return leaf;
}

/// The quadtree while it is built, as a grid of the smallest cells.
class Quadtree {
 public:
  Quadtree(const DisparityImage& image, const std::vector<std::uint8_t>& wanted, const QuadtreeSettings& settings)
      : image_(image),
        wanted_(wanted),
        settings_(settings),
        unit_(settings.leaf_min),
        cols_((image.cols - 2) / unit_ + 1),
        rows_((image.rows - 2) / unit_ + 1),
        leaf_of_(static_cast<std::size_t>(cols_ * rows_), kNone) {}

  std::vector<Leaf> run() {
    const int largest = std::max(settings_.leaf_max, unit_);
    for (int y = 0; y < rows_ * unit_; y += largest)
      for (int x = 0; x < cols_ * unit_; x += largest) grow(x, y, largest);
    balance();
    return in_order();
  }

 private:
  static constexpr int kNone = -1;

  bool has_wanted(int x, int y, int size) const {
    for (int v = y; v <= std::min(y + size, image_.rows - 1); ++v)
      for (int u = x; u <= std::min(x + size, image_.cols - 1); ++u)
        if (wanted_[image_.at(u, v)]) return true;
    return false;
  }

  void grow(int x, int y, int size) {
    if (x >= image_.cols - 1 || y >= image_.rows - 1 || !has_wanted(x, y, size)) return;
    if (auto leaf = fit(image_, x, y, size, settings_)) return place(*leaf);
    if (size == unit_) return;
    const int half = size / 2;
    for (int k = 0; k < 4; ++k) grow(x + (k & 1) * half, y + (k >> 1) * half, half);
  }

  void place(const Leaf& leaf) {
    const int number = static_cast<int>(leaves_.size());
    leaves_.push_back(leaf);
    for (int v = leaf.y / unit_; v < std::min((leaf.y + leaf.size) / unit_, rows_); ++v)
      for (int u = leaf.x / unit_; u < std::min((leaf.x + leaf.size) / unit_, cols_); ++u)
        leaf_of_[static_cast<std::size_t>(v * cols_ + u)] = number;
  }

  /// Splits leaves beside ones of less than half their size until there are none.
  void balance() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < leaves_.size(); ++i)
        if (leaves_[i].size > 2 * smallest_neighbour(leaves_[i])) {
          split(i);
          changed = true;
        }
    }
  }

  int smallest_neighbour(const Leaf& leaf) const {
    int least = leaf.size;
    const int x = leaf.x / unit_, y = leaf.y / unit_, n = leaf.size / unit_;
    for (int i = 0; i < n; ++i)
      for (auto [u, v] : {std::pair{x - 1, y + i}, {x + n, y + i}, {x + i, y - 1}, {x + i, y + n}}) {
        if (u < 0 || v < 0 || u >= cols_ || v >= rows_) continue;
        const int other = leaf_of_[static_cast<std::size_t>(v * cols_ + u)];
        if (other != kNone) least = std::min(least, leaves_[static_cast<std::size_t>(other)].size);
      }
    return least;
  }

  void split(std::size_t i) {
    const Leaf whole = leaves_[i];
    const int half = whole.size / 2;
    leaves_[i].size = half;  // the first child takes the number over
    for (int k = 1; k < 4; ++k) {
      Leaf child = whole;
      child.size = half;
      child.x += (k & 1) * half;
      child.y += (k >> 1) * half;
      child.c = whole.disparity(child.x, child.y);
      if (child.x < image_.cols - 1 && child.y < image_.rows - 1) place(child);
    }
  }

  std::vector<Leaf> in_order() const {
    std::vector<Leaf> ordered;
    ordered.reserve(leaves_.size());
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < cols_; ++x) {
        const int number = leaf_of_[static_cast<std::size_t>(y * cols_ + x)];
        if (number == kNone) continue;
        const Leaf& leaf = leaves_[static_cast<std::size_t>(number)];
        if (leaf.x == x * unit_ && leaf.y == y * unit_) ordered.push_back(leaf);
      }
    return ordered;
  }

  const DisparityImage& image_;
  const std::vector<std::uint8_t>& wanted_;
  const QuadtreeSettings& settings_;
  int unit_, cols_, rows_;
  std::vector<int> leaf_of_;  // [rows_*cols_] number of the leaf that covers the cell
  std::vector<Leaf> leaves_;
};

constexpr float kSameSurface =
    0.03f;  // planes that differ by more at a corner without a measurement belong to two surfaces

/// Planes that meet at a corner.
struct Meeting {
  float sum = 0, a = 0, b = 0, least = 0, most = 0;
  int leaves = 0, spacing = 0;
};

}  // namespace

void DisparityImage::build(const UpdateView& view, const std::vector<std::uint8_t>& wanted, int radius,
                           float pair_sigmas) {
  cols = view.cols();
  rows = view.rows();
  value.resize(view.depth.size());
  sigma.resize(view.depth.size());
  for (std::size_t p = 0; p < value.size(); ++p) {
    value[p] = 1.0f / view.depth[p];
    sigma[p] = view.sigma[p] * value[p] * value[p];
  }
  if (radius == 0) return;
  std::vector<float> smooth = value;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < cols; ++x)
      if (wanted[at(x, y)] && value[at(x, y)] == value[at(x, y)])
        smooth[at(x, y)] = smoothed(*this, x, y, radius, pair_sigmas);
  value.swap(smooth);
}

std::vector<Leaf> disparity_leaves(const DisparityImage& image, const std::vector<std::uint8_t>& wanted,
                                   const QuadtreeSettings& settings) {
  return Quadtree(image, wanted, settings).run();
}

std::vector<LeafCorner> leaf_corners(const DisparityImage& image, const std::vector<Leaf>& leaves, float fit_sigmas) {
  std::vector<int> number(image.value.size(), -1);  // [px] of the meeting there
  std::vector<Meeting> meetings;
  meetings.reserve(2 * leaves.size());
  for (const Leaf& leaf : leaves)
    for (int k = 0; k < 4; ++k) {
      const int x = std::min(leaf.x + (k & 1) * leaf.size, image.cols - 1),
                y = std::min(leaf.y + (k >> 1) * leaf.size, image.rows - 1);
      const auto p = image.at(x, y);
      const float d = leaf.disparity(x, y);
      if (d <= 0 || std::abs(d - image.value[p]) > fit_sigmas * image.sigma[p]) continue;
      if (number[p] < 0) {
        number[p] = static_cast<int>(meetings.size());
        meetings.emplace_back();
      }
      Meeting& m = meetings[static_cast<std::size_t>(number[p])];
      m.least = m.leaves ? std::min(m.least, d) : d;
      m.most = m.leaves ? std::max(m.most, d) : d;
      m.spacing = m.leaves ? std::min(m.spacing, leaf.size) : leaf.size;
      m.sum += d;
      m.a += leaf.a;
      m.b += leaf.b;
      ++m.leaves;
    }
  std::vector<LeafCorner> corners;
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      if (number[image.at(x, y)] < 0) continue;
      const Meeting& m = meetings[static_cast<std::size_t>(number[image.at(x, y)])];
      const auto n = static_cast<float>(m.leaves);
      const float mean = m.sum / n;
      const bool measured = image.value[image.at(x, y)] == image.value[image.at(x, y)];
      if (measured || m.most - m.least <= kSameSurface * mean)
        corners.push_back({x, y, mean, m.a / n, m.b / n, m.spacing});
    }
  return corners;
}

}  // namespace ppm
