#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/maps/ppm/update_view.hpp"

namespace ppm {

/// A face of the map.
struct FaceRef {
  std::uint32_t chunk = 0, face = 0;
  auto operator<=>(const FaceRef&) const = default;
};

/// A vertex that new faces may use: one on the boundary of the map, or a new one.
struct RimVertex {
  static constexpr std::uint32_t kNew = 0xffffffffu;
  std::uint32_t id = kNew;   ///< the map's; kNew until the edit session gives it one
  Eigen::Vector3f position;  ///< m, map frame
  Eigen::Vector3f point;     ///< the same relative to the view's centre
  Eigen::Vector3f normal;    ///< unit
};

/// The boundary of the mesh in a view, over all chunks: the directed edges of faces that have no partner on the other
/// side. It is kept up to date while faces are taken away and put on, and refuses faces that would give an edge three
/// faces or two wound alike. Vertices are numbered within the boundary. Complete for edges whose both ends are in the
/// image.
class Boundary {
 public:
  /// Reads the chunks in view; faces of `removed` (ascending) count as taken away already.
  void build(const PpmMap& map, const UpdateView& view, const std::vector<FaceRef>& removed);

  std::vector<RimVertex> vertex;

  /// True when the directed edge belongs to a face and its reverse to none.
  bool is_open(std::uint32_t a, std::uint32_t b) const { return find(a, b, Kind::open) != kNone; }
  /// True when the vertex has an open edge.
  bool is_rim(std::uint32_t a) const;
  /// True when a face (a, b, c), in winding order, leaves every edge sound.
  bool accepts(const std::array<std::uint32_t, 3>& face) const;
  /// True when a face may have the directed edge (a, b): no face has it yet, and it has not two faces.
  bool accepts_edge(std::uint32_t a, std::uint32_t b) const { return !is_open(a, b) && !is_shared(a, b); }
  void add(const std::array<std::uint32_t, 3>& face);
  /// A new vertex, without a face yet; returns its number.
  std::uint32_t add_vertex(const UpdateView& view, const Eigen::Vector3f& point, const Eigen::Vector3f& normal);
  /// The ends of the open edges that leave a vertex.
  void open_from(std::uint32_t a, std::vector<std::uint32_t>& ends) const;

 private:
  enum class Kind : std::uint8_t {
    open,
    shared
  };  // shared: the edge has both its faces; kept once, from the lower number
  struct Link {
    std::uint32_t to, next;
    Kind kind;
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::uint32_t number_of(const Geometry& geometry, std::uint32_t id, const UpdateView& view);
  void read_open_edges(const Geometry& geometry, const UpdateView& view);
  void pair_chunk_borders();
  void take_away(const Geometry& geometry, std::uint32_t face, const UpdateView& view);
  void read_shared_edges(const Geometry& geometry, std::uint32_t chunk, const std::vector<FaceRef>& removed);
  std::uint32_t find(std::uint32_t a, std::uint32_t b, Kind kind) const;
  bool is_shared(std::uint32_t a, std::uint32_t b) const {
    return find(std::min(a, b), std::max(a, b), Kind::shared) != kNone;
  }
  void link(std::uint32_t a, std::uint32_t b, Kind kind);
  void unlink(std::uint32_t a, std::uint32_t b, Kind kind);
  void share(std::uint32_t a, std::uint32_t b);

  std::vector<std::uint32_t> number_of_id_;  // by the map's vertex id; kNone = not in the boundary
  std::vector<std::uint32_t> first_;         // by vertex: its first link
  std::vector<Link> links_;
  std::vector<std::uint32_t> local_;  // scratch: numbers of a chunk's vertices
};

}  // namespace ppm
