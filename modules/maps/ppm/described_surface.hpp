#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "framework/slam/chunk_table.hpp"
#include "modules/maps/ppm/chunk.hpp"

namespace ppm {

/// A face with its texels, in a map or on its way there. The texels' memory is another's.
struct TexturedFace {
  std::array<Eigen::Vector3f, 3> corner;  ///< m, counter-clockwise seen from free space
  std::uint32_t divisions = 1;
  FaceEvidence evidence;
  TexelView texels;  ///< [texel_count(divisions)]
};
/// A face of a chunk; good until the chunk is edited.
TexturedFace textured_face(const PpmChunk& chunk, std::uint32_t face);

/// Where a line meets a described surface.
struct SurfaceHit {
  float offset = 0;        ///< m along the line's direction
  float miss = 0;          ///< m, how far beside the face; 0 where the line meets it
  std::uint32_t face = 0;  ///< in the list that the surface was made from
  TexelTriangle texels{};  ///< of that face, around the point that is met
};

/// A piece of plane from which lines are cast along its unit normal: point (a, b) is origin + a edge1 + b edge2.
struct CastPlane {
  Eigen::Vector3f origin, edge1, edge2, normal;
};

/// What it means for a line to meet a described surface.
enum class Meeting {
  displaced,  ///< each face moved along its normal by its texel means; neighbours may gape or overlap at folds
  /// As a view along the line meets it: the line meets the face, the surface stands off there by the texel's mean.
  /// Neighbours leave neither gap nor overlap. It is what map update and prediction mean by a texel.
  seen,
};

/// The surface that textured faces describe, means interpolated linearly between texels. Finds where lines meet it. The
/// faces must outlive it.
class DescribedSurface {
 public:
  explicit DescribedSurface(std::span<const TexturedFace> faces, Meeting meeting = Meeting::displaced);

  /// Makes ready for lines from within the triangle (0, 0), (1, 0), (0, 1) of a plane: the faces within `reach` of it (m),
  /// all where none is so near. Faces that look away from the plane's normal by more than 75 degrees are left out.
  void aim(const CastPlane& plane, float reach);
  /// Where the line through (a, b) of the plane along its normal meets the surface: of several places the nearest, or, as
  /// seen, that of the nearest face. Where it meets none, as in the gap that opens between two faces at a fold, the
  /// nearest point beside the line (SurfaceHit::miss), with the offset of its face's displaced plane. Where all faces
  /// look away, miss is infinite. There must be a face.
  SurfaceHit cast(float a, float b) const;

 private:
  struct Plane {  // of a face: u, v and height of a point x are axis . (x - corner 0)
    Eigen::Vector3f normal, u_axis, v_axis;
    float farthest_mean;  // m
  };
  struct Linear {  // value + a by_a + b by_b over the aimed plane
    float value, by_a, by_b;
    float at(float a, float b) const { return value + a * by_a + b * by_b; }
  };
  struct Target {
    std::uint32_t face;
    Linear u, v, height;     // of the plane's point
    float u_slope, v_slope;  // change with the way along the line
    float facing;            // cosine between the normals
    float slack;             // in u and v: how far the means can shift a hit
  };
  void aim_at(const CastPlane& plane, std::uint32_t face, float facing);
  SurfaceHit meet(const Target& target, float a, float b) const;
  template <class Visit>
  void cells(const Eigen::Vector3f& low, const Eigen::Vector3f& high, Visit visit) const;

  std::span<const TexturedFace> faces_;
  Meeting meeting_;
  std::vector<Plane> plane_;
  float cell_size_ = 1;  // m
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> grid_;
  std::vector<std::uint32_t> aimed_;  // by face: number of the aim that saw it last
  std::uint32_t aim_ = 0;
  std::vector<Target> target_;
  bool away_ = false;  // all faces look away
};

}  // namespace ppm
