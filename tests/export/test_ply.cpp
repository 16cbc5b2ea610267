// PLY and OBJ as another program reads them: OpenMesh.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <catch2/catch.hpp>

#include "modules/maps/export/export.hpp"
#include "tests/export/export_maps.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;

namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Color = OpenMesh::Vec3f;
  VertexAttributes(OpenMesh::Attributes::Normal | OpenMesh::Attributes::Color);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::TexCoord2D);
};
using OtherMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

OtherMesh read(const std::filesystem::path& file, OpenMesh::IO::Options& options) {
  OtherMesh mesh;
  REQUIRE(OpenMesh::IO::read_mesh(mesh, file.string(), options));
  return mesh;
}

void export_to(const std::filesystem::path& file, const Map& map, Surface surface) {
  ExportSettings settings;
  settings.format = *format_of(file);
  settings.surface = surface;
  write(export_map(map, settings, file, "map.ppm"));
}

Eigen::Vector3f as_eigen(const OtherMesh::Point& p) {
  return {p[0], p[1], p[2]};
}

void same_shape(const OtherMesh& other, const Mesh& mesh, float tolerance) {
  REQUIRE(other.n_vertices() == mesh.position.size());
  REQUIRE(other.n_faces() == mesh.face.size());
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    const auto vertex = other.vertex_handle(static_cast<unsigned>(v));
    REQUIRE((as_eigen(other.point(vertex)) - mesh.position[v]).norm() <= tolerance);
  }
  for (std::size_t f = 0; f < mesh.face.size(); ++f) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t k = 0;
    for (const auto v : other.fv_range(other.face_handle(static_cast<unsigned>(f))))
      corners[k++] = static_cast<std::uint32_t>(v.idx());
    while (corners[0] != mesh.face[f][0] && k-- > 0) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    REQUIRE(corners == mesh.face[f]);
  }
}

}  // namespace

TEST_CASE("OpenMesh reads the PLY of either surface: positions, normals, colours, mean and sigma") {
  test::TempFolder dir;
  const auto map = test::textured_sheet();
  for (const auto surface : {Surface::base, Surface::displaced}) {
    const Mesh mesh = map->mesh(surface);
    export_to(dir / "map.ply", *map, surface);
    OpenMesh::IO::Options options = OpenMesh::IO::Options::VertexNormal;
    options += OpenMesh::IO::Options::VertexColor;
    options += OpenMesh::IO::Options::Custom;
    const OtherMesh other = read(dir / "map.ply", options);
    CHECK(options.vertex_has_normal());
    CHECK(options.vertex_has_color());
    CHECK(options.is_binary());
    same_shape(other, mesh, 0);
    OpenMesh::VPropHandleT<float> mean, sigma;
    REQUIRE(other.get_property_handle(mean, "mean"));
    REQUIRE(other.get_property_handle(sigma, "sigma"));
    for (std::size_t v = 0; v < mesh.position.size(); ++v) {
      const auto vertex = other.vertex_handle(static_cast<unsigned>(v));
      REQUIRE(other.property(mean, vertex) == mesh.mean[v]);
      REQUIRE(other.property(sigma, vertex) == std::sqrt(mesh.variance[v]));
      REQUIRE(as_eigen(other.normal(vertex)) == mesh.normal[v]);
    }
  }
}

TEST_CASE("OpenMesh reads the OBJ of either surface, with texture coordinates on the base") {
  test::TempFolder dir;
  const auto map = test::textured_sheet();
  for (const auto surface : {Surface::base, Surface::displaced}) {
    const bool textured = surface == Surface::base;
    export_to(dir / "map.obj", *map, surface);
    OpenMesh::IO::Options options = OpenMesh::IO::Options::VertexNormal;
    options += OpenMesh::IO::Options::FaceTexCoord;
    const OtherMesh other = read(dir / "map.obj", options);
    same_shape(other, map->mesh(surface), 1e-5f);
    CHECK(options.face_has_texcoord() == textured);
    CHECK(std::filesystem::exists(dir / "map.mtl") == true);
    CHECK(std::filesystem::exists(dir / "map_texture.png") == true);
    CHECK((test::bytes_of(dir / "map.obj").find("mtllib map.mtl") != std::string::npos) == textured);
  }
  CHECK(test::bytes_of(dir / "map.mtl").find("map_Kd map_texture.png") != std::string::npos);
}

TEST_CASE("a map's own colour goes into its exports") {
  const auto map = test::textured_sheet(3);
  const Mesh mesh = map->mesh(Surface::displaced);
  REQUIRE(mesh.color.size() == mesh.position.size());
  const auto exported = export_map(*map, {}, "map.ply", "map.ppm");
  CHECK(exported.show == Show::color);
  CHECK_FALSE(exported.scale);
  CHECK(test::textured_sheet(1)->mesh(Surface::base).color.front().x() > 0);  // one channel: grey
  ExportSettings settings;
  settings.show = Show::color;
  CHECK_THROWS_WITH(export_map(*test::textured_sheet(0), settings, "map.ply", "map.ppm"),
                    Catch::Contains("map.ppm") && Catch::Contains("no colour"));
}
