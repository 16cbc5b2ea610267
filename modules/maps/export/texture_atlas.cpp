#include "modules/maps/export/texture_atlas.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ppm {
namespace {

// The rectangle of a pair whose larger face has n divisions: the gutters of the two just do not meet.
int width_of(int n) {
  return n + 5;
}
int height_of(int n) {
  return n + 4;
}

/// The colour of pixel (i, j) of a face, on its texels or in its gutter.
class FacePixels {
 public:
  FacePixels(const Color* texel, int n) : texel_(texel), n_(n) {}
  Color at(int i, int j) const {
    // The fourth corner of a square that the face's slanted side cuts: it makes the bilinear form linear in the face.
    if (i > 0 && j > 0 && i + j == n_ + 1) return texel(i - 1, j) + texel(i, j - 1) - texel(i - 1, j - 1);
    return texel(std::clamp(i, 0, n_), std::clamp(j, 0, n_));
  }

 private:
  const Color& texel(int i, int j) const {
    return texel_[texel_index(static_cast<std::uint32_t>(n_), static_cast<std::uint32_t>(i),
                              static_cast<std::uint32_t>(j))];
  }
  const Color* texel_;
  int n_;
};

}  // namespace

TextureAtlas::TextureAtlas(std::span<const std::uint8_t> divisions) : places_(divisions.size()) {
  std::uint32_t texels = 0;
  for (std::size_t f = 0; f < divisions.size(); ++f) {
    places_[f].divisions = divisions[f];
    places_[f].first_texel = texels;
    texels += texel_count(divisions[f]);
  }
  pack(divisions);
}

void TextureAtlas::pack(std::span<const std::uint8_t> divisions) {
  std::vector<std::size_t> order(divisions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return divisions[a] > divisions[b]; });
  double area = 0;
  for (std::size_t k = 0; k < order.size(); k += 2)
    area += width_of(divisions[order[k]]) * height_of(divisions[order[k]]);
  cols_ = std::max(static_cast<int>(std::ceil(std::sqrt(area))), 1);
  if (!order.empty()) cols_ = std::max(cols_, width_of(divisions[order[0]]));
  int x = 0, y = 0, row = 0;
  for (std::size_t k = 0; k < order.size(); k += 2) {
    const int w = width_of(divisions[order[k]]), h = height_of(divisions[order[k]]);
    if (x + w > cols_) {
      x = 0;
      y += row;
      row = 0;
    }
    row = std::max(row, h);
    Place& first = places_[order[k]];
    first.x = x + 1;
    first.y = y + 1;
    if (k + 1 < order.size()) {
      Place& second = places_[order[k + 1]];
      second.x = x + w - 2;
      second.y = y + h - 2;
      second.step = -1;
    }
    x += w;
  }
  rows_ = std::max(y + row, 1);
}

std::array<Eigen::Vector2f, 3> TextureAtlas::uv(std::size_t face) const {
  const Place& place = places_[face];
  auto at = [&](int i, int j) {  // the middle of a pixel
    return Eigen::Vector2f((static_cast<float>(place.x + place.step * i) + 0.5f) / static_cast<float>(cols_),
                           (static_cast<float>(place.y + place.step * j) + 0.5f) / static_cast<float>(rows_));
  };
  return {at(0, 0), at(place.divisions, 0), at(0, place.divisions)};
}

RgbImage TextureAtlas::paint(std::span<const Color> texel) const {
  RgbImage image{cols_, rows_, {}};
  image.rgb.assign(3 * static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows_), 128);
  for (const Place& place : places_) {
    const int n = place.divisions;
    const FacePixels pixels(&texel[place.first_texel], n);
    for (int j = -1; j <= n + 1; ++j)
      for (int i = -1; i <= n + 1 && i + j <= n + 1; ++i) {
        const int x = place.x + place.step * i, y = place.y + place.step * j;
        const auto at = 3 * (static_cast<std::ptrdiff_t>(y) * cols_ + x);
        const auto bytes = to_bytes(pixels.at(i, j));
        std::copy(bytes.begin(), bytes.end(), image.rgb.begin() + at);
      }
  }
  return image;
}

}  // namespace ppm
