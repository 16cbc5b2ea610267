#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace ppm {

struct FaceEvidence;

/// An array for SIMD: begins at a cache line, is not initialised, and keeps its memory when it shrinks. T: trivial.
template <class T>
class AlignedArray {
 public:
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  /// Makes room for `count` values; `kept` of those that are there stay.
  void reserve(std::size_t count, std::size_t kept = 0) {
    if (count <= capacity_) return;
    capacity_ = std::max(count, 2 * capacity_);
    std::unique_ptr<T[], Free> grown(static_cast<T*>(::operator new(capacity_ * sizeof(T), kLine)));
    std::copy_n(data_.get(), kept, grown.get());
    data_ = std::move(grown);
  }

 private:
  static constexpr std::align_val_t kLine{64};
  struct Free {
    void operator()(T* p) const { ::operator delete(p, kLine); }
  };
  std::unique_ptr<T[], Free> data_;
  std::size_t capacity_ = 0;
};

/// What the texture of a chunk says, as plain arrays of the map.
struct RasterTexels {
  std::uint32_t chunk = 0;
  const std::uint8_t* divisions = nullptr;
  const std::uint32_t* first_texel = nullptr;
  const FaceEvidence* evidence = nullptr;
  const float* mean = nullptr;
  const float* variance = nullptr;
};

/// Some rows of a view, drawn: the triangle that each pixel shows, and the triangles that were drawn. A triangle is
/// four quads of floats, each kept in an array of its own. Image coordinates (x, y) count from the camera's middle.
///   quad 0  edge 1 (a, b, c), scale     barycentric u = edge1(x, y) * scale / inverse_depth(x, y),
///   quad 1  edge 2 (a, b, c), slope     v likewise of edge 2; edge(x, y) = a x + b y + c, not negative inside
///   quad 2  plane (a, b, c), face       inverse_depth(x, y) = a x + b y + c, 1/m along the optical axis
///   quad 3  edge 0 (a, b, c), slot
/// slope: 1/m, of the distance from the camera's centre to the face's plane, negative where the face is seen from
/// behind; face (in its chunk) and slot (of its chunk in `texels`) are integers in a float's place.
struct RasterBand {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::size_t kSpare = 16;  ///< entries past the end of every array that kernels may touch

  int first_row = 0, end_row = 0;
  /// The face that a triangle is, in its chunk.
  std::uint32_t face_of(std::uint32_t triangle) const { return integer(2, triangle); }
  /// What the texture of its chunk says.
  const RasterTexels& texels_of(std::uint32_t triangle) const { return texels[integer(3, triangle)]; }

  AlignedArray<std::uint32_t> shown;  ///< [rows*cols] triangle; kNone = miss
  AlignedArray<float> quad[4];        ///< [triangles*4]
  std::size_t triangles = 0;
  std::vector<RasterTexels> texels;  ///< by slot

 private:
  std::uint32_t integer(int k, std::uint32_t triangle) const {
    return std::bit_cast<std::uint32_t>(quad[k].data()[4 * std::size_t{triangle} + 3]);
  }
};

}  // namespace ppm
