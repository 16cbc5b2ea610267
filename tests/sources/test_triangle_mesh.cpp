#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "modules/sources/mesh_rays.hpp"
#include "modules/sources/triangle_mesh.hpp"
#include "tests/sources/ply_files.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

TriangleMesh mesh_of(const std::string& text) {
  const TempFolder folder;
  write_text(folder / "a.ply", text);
  return read_ply_mesh(folder / "a.ply");
}

/// What is wrong with a file, from its name on.
std::string error_of(const std::string& text) {
  try {
    mesh_of(text);
  } catch (const DataError& e) {
    const std::string what = e.what();
    return what.substr(what.find("a.ply"));
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("a text mesh is read and its faces are cut into triangles") {
  const TriangleMesh mesh = mesh_of(two_squares());
  REQUIRE(mesh.position.size() == 8);
  CHECK(mesh.position[4] == Eigen::Vector3f(1, -0.5f, 0.5f));
  CHECK(mesh.face == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}});
}

TEST_CASE("a binary mesh is read") {
  const TriangleMesh mesh = mesh_of(binary_square());
  REQUIRE(mesh.position.size() == 4);
  CHECK(mesh.position[2] == Eigen::Vector3f(3, 1, -1));
  CHECK(mesh.face == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {2, 1, 3}});
}

TEST_CASE("what is wrong with a mesh's file is said with its place") {
  const std::string text = two_squares();
  CHECK(error_of("solid") == "a.ply:1:1: the file ends within the header");
  CHECK(error_of("off\n") == "a.ply:1:1: is no PLY file: it does not begin with the line 'ply'");
  CHECK(error_of(replaced(text, "ascii", "binary_big_endian")) ==
        "a.ply:2:1: the format is neither 'ascii 1.0' nor 'binary_little_endian 1.0'");
  CHECK(error_of(replaced(text, "format ascii 1.0\n", "")) == "a.ply:12:1: the header names no format");
  CHECK(error_of(replaced(text, "float z", "real z")) == "a.ply:7:1: 'real' is no type of PLY files");
  CHECK(error_of(replaced(text, "float z", "float w")) == "a.ply: the element 'vertex' lacks a coordinate (x, y, z)");
  CHECK(error_of(replaced(text, "vertex_indices", "corners")) == "a.ply: the element 'face' lacks the list 'vertex_indices'");
  CHECK(error_of(replaced(text, "element face", "element faces")) == "a.ply: has no element 'face'");
  CHECK(error_of(replaced(text, "vertex 8", "vertex many")) == "a.ply:4:1: 'many' is no number of elements");
  CHECK(error_of(replaced(text, "2 2 3 9", "2 two 3 9")) == "a.ply:16:1: 'two' is no number");
  CHECK(error_of(replaced(text, "2 2 3 9", "2 nan 3 9")) == "a.ply:16:1: a vertex is not finite");
  CHECK(error_of(replaced(text, "4 4 5 6 7", "2 4 5")) == "a.ply:23:1: a face has 2 corners");
  CHECK(error_of(replaced(text, "4 4 5 6 7", "4 4 5 6 8")) == "a.ply: triangle 3 names vertex 8 of 8");
  CHECK(error_of(replaced(text, "4 4 5 6 7", "4 4 5 6 -1")) == "a.ply:23:1: -1 is no number of a vertex");
  CHECK(error_of(text.substr(0, text.size() - 2)) == "a.ply:24:1: the file ends early");
  CHECK(error_of(replaced(replaced(text, "face 2", "face 0"), "4 0 1 2 3\n4 4 5 6 7\n", "")) == "a.ply: holds no face");
  CHECK(error_of(binary_square(4)) == "a.ply: triangle 1 names vertex 4 of 4");
  const std::string binary = binary_square();
  CHECK(error_of(binary.substr(0, binary.size() - 3)) ==
        fmt::format("a.ply: byte {}: the file ends early", binary.size() - 4));
  CHECK_THROWS_AS(read_ply_mesh("no/such/file.ply"), DataError);
}

TEST_CASE("rays end at the nearest face, whichever side it shows") {
  const MeshRays rays(mesh_of(two_squares()));
  const std::vector<Eigen::Vector3f> direction = {
      {1, 0, 0}, Eigen::Vector3f(2, 1.5f, 0).normalized(), {-1, 0, 0}, Eigen::Vector3f(1, 0.2f, 0.2f).normalized()};
  std::vector<MeshHit> hit(direction.size());
  rays.cast({0, 0, 1}, direction, hit);
  CHECK(hit[0].range_m == Approx(1));
  CHECK(hit[0].normal.isApprox(Eigen::Vector3f(-1, 0, 0)));
  CHECK(hit[1].range_m == Approx(2.5));
  CHECK(std::isinf(hit[2].range_m));
  CHECK(hit[3].range_m == Approx(std::sqrt(1.08)));
  rays.cast({3, 0, 1}, direction, hit);
  CHECK(hit[2].range_m == Approx(1));
  CHECK(hit[2].normal.isApprox(Eigen::Vector3f(1, 0, 0)));
}

TEST_CASE("many rays at once end where each alone does") {
  const MeshRays rays(mesh_of(two_squares()));
  std::vector<Eigen::Vector3f> direction;
  for (int k = 0; k < 37; ++k) direction.push_back(Eigen::Vector3f(1, 0.03f * static_cast<float>(k - 18), 0).normalized());
  std::vector<MeshHit> all(direction.size()), one(1);
  rays.cast({0, 0, 1}, direction, all);
  for (std::size_t k = 0; k < direction.size(); ++k) {
    rays.cast({0, 0, 1}, std::span(direction).subspan(k, 1), one);
    CHECK(all[k].range_m == one[0].range_m);
  }
}
