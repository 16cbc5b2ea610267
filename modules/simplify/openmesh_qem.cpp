#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Geometry/QuadricT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>

#include "framework/graph/registry.hpp"
#include "modules/simplify/map_simplifier.hpp"

namespace {

using namespace ppm;

struct MeshTraits : OpenMesh::DefaultTraits {
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;
using Quadric = OpenMesh::Geometry::QuadricT<double>;

/// Orders collapses by the mean squared distance, over area, from the planes that a vertex stands for; refuses those
/// beyond the error, and those that turn a face by more than 75 degrees. Open borders are held by planes upright on
/// them.
class MeanDistance final : public OpenMesh::Decimater::ModBaseT<HalfedgeMesh> {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<MeanDistance>;
  using Info = OpenMesh::Decimater::CollapseInfoT<HalfedgeMesh>;
  explicit MeanDistance(HalfedgeMesh& mesh) : ModBaseT(mesh, false) {}

  double error = 0;  ///< m

  const std::string& name() const override {
    static const std::string name = "MeanDistance";
    return name;
  }

  void initialize() override {
    planes_.assign(mesh().n_vertices(), {});
    for (const auto face : mesh().faces()) {
      std::array<HalfedgeMesh::VertexHandle, 3> v;
      std::array<OpenMesh::Vec3d, 3> p;
      auto it = mesh().cfv_begin(face);
      for (std::size_t k = 0; k < 3; ++k, ++it) {
        v[k] = *it;
        p[k] = OpenMesh::vector_cast<OpenMesh::Vec3d>(mesh().point(*it));
      }
      const OpenMesh::Vec3d cross = (p[1] - p[0]) % (p[2] - p[0]);
      const double length = cross.norm();
      if (!(length > 0)) continue;
      for (auto corner : v) add(corner, cross / length, p[0], length / 2);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto edge = mesh().find_halfedge(v[k], v[(k + 1) % 3]);
        if (!mesh().is_boundary(mesh().opposite_halfedge_handle(edge))) continue;
        const OpenMesh::Vec3d along = p[(k + 1) % 3] - p[k], across = along % cross;
        for (auto end : {v[k], v[(k + 1) % 3]}) add(end, across / across.norm(), p[k], kBorderWeight * along.sqrnorm());
      }
    }
  }

  float collapse_priority(const Info& info) override {
    const auto &from = planes_[index(info.v0)], &to = planes_[index(info.v1)];
    Quadric sum = from.quadric;
    sum += to.quadric;
    const double mean = sum(info.p1) / (from.weight + to.weight);
    if (mean > error * error || turns(info)) return ILLEGAL_COLLAPSE;
    return static_cast<float>(std::max(mean, 0.0));
  }

  void postprocess_collapse(const Info& info) override {
    auto &from = planes_[index(info.v0)], &to = planes_[index(info.v1)];
    to.quadric += from.quadric;
    to.weight += from.weight;
  }

 private:
  static constexpr double kBorderWeight = 10;
  static constexpr float kLeastCosine = 0.26f;
  struct Planes {
    Quadric quadric{};
    double weight = 0;  // m^2
  };
  static std::size_t index(HalfedgeMesh::VertexHandle v) { return static_cast<std::size_t>(v.idx()); }

  void add(HalfedgeMesh::VertexHandle v, const OpenMesh::Vec3d& normal, const OpenMesh::Vec3d& point, double weight) {
    Quadric plane(normal[0], normal[1], normal[2], -(normal | point));
    plane *= weight;
    planes_[index(v)].quadric += plane;
    planes_[index(v)].weight += weight;
  }

  /// True where a face around the vertex that goes would look elsewhere.
  bool turns(const Info& info) {
    for (auto it = mesh().cvf_begin(info.v0); it.is_valid(); ++it) {
      if (*it == info.fl || *it == info.fr) continue;
      std::array<OpenMesh::Vec3f, 3> before, after;
      auto corner = mesh().cfv_begin(*it);
      for (std::size_t k = 0; k < 3; ++k, ++corner) {
        before[k] = mesh().point(*corner);
        after[k] = *corner == info.v0 ? info.p1 : before[k];
      }
      const auto was = (before[1] - before[0]) % (before[2] - before[0]),
                 is = (after[1] - after[0]) % (after[2] - after[0]);
      if (!((was | is) > kLeastCosine * was.norm() * is.norm())) return true;
    }
    return false;
  }

  std::vector<Planes> planes_;  // by vertex
};

/// Makes mature parts of a mesh of fewer faces, by collapsing edges in the order of a quadric error.
/// belief  drops the prediction: its elements are no longer those of the map
/// source  paper, section 4.3; Garland and Heckbert, SIGGRAPH 1997
class OpenMeshSimplifier final : public MapSimplifier {
 protected:
  std::vector<Triangle> decimate(const Decimation& surface) const override {
    HalfedgeMesh mesh;
    std::vector<HalfedgeMesh::VertexHandle> vertex;
    for (const auto& p : surface.position) vertex.push_back(mesh.add_vertex({p.x(), p.y(), p.z()}));
    std::vector<std::uint8_t> locked = surface.locked;
    std::vector<Triangle> left;
    for (const auto& f : surface.face) {
      if (mesh.add_face(vertex[f[0]], vertex[f[1]], vertex[f[2]]).is_valid()) continue;
      left.push_back(f);  // two fans of faces meet in one of its vertices: no half-edge mesh takes that
      for (auto v : f) locked[v] = 1;
    }
    for (std::size_t v = 0; v < locked.size(); ++v) mesh.status(vertex[v]).set_locked(locked[v] != 0);

    OpenMesh::Decimater::DecimaterT<HalfedgeMesh> decimater(mesh);
    MeanDistance::Handle distance;
    decimater.add(distance);
    decimater.module(distance).error = surface.error;
    PPM_CHECK(decimater.initialize(), "OpenMesh refuses the decimation module");
    decimater.decimate();

    for (const auto face : mesh.faces()) {  // skips deleted ones
      Triangle t;
      auto it = mesh.cfv_begin(face);
      for (std::size_t k = 0; k < 3; ++k, ++it) t[k] = static_cast<std::uint32_t>(it->idx());
      left.push_back(t);
    }
    return left;
  }
};

}  // namespace

PPM_MODULES(r) {
  r.add<OpenMeshSimplifier>("simplify.openmesh_qem",
                            "Fewer faces for the same described surface, by OpenMesh's decimater with quadrics.",
                            "paper, section 4.3; Garland and Heckbert 1997; OpenMesh");
}
