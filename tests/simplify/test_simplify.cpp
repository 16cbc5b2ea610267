#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "framework/core/rng.hpp"
#include "framework/graph/harness.hpp"
#include "modules/maps/ppm/described_surface.hpp"
#include "modules/maps/ppm/welding.hpp"
#include "tests/support/mesh_map.hpp"
#include "tests/support/ppm_maps.hpp"
#include "tests/support/registry.hpp"

namespace {

using namespace ppm;
using MapPointer = std::shared_ptr<const PpmMap>;
using Height = std::function<float(float, float)>;

const char* const kModules[] = {"simplify.meshoptimizer", "simplify.openmesh_qem"};

/// All faces take part, and standard deviations do not count.
const std::string kExact = "hits_least: 0, sigmas: 0";

MapPointer simplified(const std::string& module, MapPointer map, const std::string& params = kExact) {
  Harness h(test::builtin(), module, "{" + params + "}");
  h.belief().init(1, Pose::Identity(), std::move(map));
  h.tick();
  auto result = std::static_pointer_cast<const PpmMap>(h.belief().map[0]);
  result->check();
  return result;
}

/// 1 m x 1 m of squares of 5 cm over several chunks.
MapPointer plate(const Height& z) {
  PpmSettings settings;
  settings.cell_size_m = 0.4;
  return test::height_field(20, 20, 0.05f, settings, z);
}

std::vector<TexturedFace> faces_of(const PpmMap& map) {
  std::vector<TexturedFace> faces;
  for (const auto& chunk : map.table().chunks())
    for (std::uint32_t f = 0; f < chunk.geometry->face.size(); ++f) faces.push_back(textured_face(chunk, f));
  return faces;
}

/// Heights of the described surface over the plate at random places; NaN where it has none.
std::vector<float> heights(const PpmMap& map) {
  const auto faces = faces_of(map);
  DescribedSurface surface(faces, Meeting::seen);
  surface.aim({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}}, 1);
  Rng rng(4, 0, 0, purpose_key("places"));
  std::vector<float> height;
  for (int k = 0; k < 400; ++k) {
    const auto hit = surface.cast(static_cast<float>(0.01 + 0.48 * rng.uniform()), static_cast<float>(0.01 + 0.48 * rng.uniform()));
    height.push_back(hit.miss < 1e-3f ? hit.offset : std::nanf(""));
  }
  return height;
}
float farthest_apart(const PpmMap& a, const PpmMap& b) {
  const auto x = heights(a), y = heights(b);
  float most = 0;
  for (std::size_t k = 0; k < x.size(); ++k) most = std::max(most, std::isnan(x[k] - y[k]) ? 1 : std::abs(x[k] - y[k]));
  return most;
}

/// Ends of the open edges of the whole mesh.
std::set<std::array<std::uint32_t, 2>> open_edges_of(const PpmMap& map) {
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const auto& chunk : map.table().chunks())
    for (const auto& face : chunk.geometry->face)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = chunk.geometry->vertex_id[face[k]], b = chunk.geometry->vertex_id[face[(k + 1) % 3]];
        if (!edges.erase({b, a})) edges.insert({a, b});
      }
  return edges;
}

float noise(float x, float y) {
  return 0.001f * std::sin(311 * x + 97 * y) * std::cos(173 * y - 31 * x);
}

/// The faces whose centroid passes the test have been hit 100 times.
template <class Test>
MapPointer with_hits(const MapPointer& map, Test&& test) {
  PpmEdit edit(map);
  for (std::uint32_t c = 0; c < map->table().size(); ++c) {
    const Geometry& geometry = *map->table()[c].geometry;
    for (std::uint32_t f = 0; f < geometry.face.size(); ++f)
      if (test(geometry.point(f, 1.0f / 3, 1.0f / 3))) edit.texels(c).evidence[f].hits = 100;
  }
  return edit.commit();
}

}  // namespace

TEST_CASE("a flat plate with noise within the tolerance becomes few faces that describe it as well") {
  const auto before = plate(noise);
  for (const auto* module : kModules) {
    INFO(module);
    const auto after = simplified(module, before);
    CHECK(after->stats().faces < before->stats().faces / 6);
    CHECK(after->stats().texels < before->stats().texels);
    CHECK(after->stats().bytes < before->stats().bytes / 2);
    CHECK(farthest_apart(*before, *after) < 0.004f);
  }
}

TEST_CASE("faces that lie off the surface carry it in their texels") {
  // The base is wavy, the described surface flat: texels hold the difference.
  const auto wavy = [](float x, float y) { return 0.006f * std::sin(9 * x) * std::cos(8 * y); };
  const auto base = plate(wavy);
  PpmEdit edit(base);
  for (std::uint32_t c = 0; c < base->table().size(); ++c) {
    const Geometry& geometry = *base->table()[c].geometry;
    Texels& texels = edit.texels(c);
    for (std::uint32_t f = 0; f < geometry.face.size(); ++f) {
      const auto n = std::uint32_t{geometry.divisions[f]};
      const float facing = geometry.face_normal(f).z();
      for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; i + j <= n; ++j) {
          const auto t = geometry.first_texel[f] + texel_index(n, i, j);
          texels.mean[t] = -facing * geometry.point(f, float(i) / float(n), float(j) / float(n)).z();
          texels.variance[t] = 1e-6f;
        }
    }
  }
  const auto before = edit.commit();
  for (float z : heights(*before)) CHECK(std::abs(z) < 0.0003f);
  for (const auto* module : kModules) {
    INFO(module);
    const auto after = simplified(module, before);
    CHECK(after->stats().faces < before->stats().faces / 6);
    for (float z : heights(*after)) CHECK(std::abs(z) < 0.002f);
  }
}

TEST_CASE("a sharp box keeps its edges") {
  // Three sides of a box around its corner, finely divided.
  test::TriangleMesh mesh;
  const int n = 10;
  for (int side = 0; side < 3; ++side) {
    const Eigen::Vector3f u = Eigen::Vector3f::Unit((side + 1) % 3), v = Eigen::Vector3f::Unit((side + 2) % 3);
    std::vector<std::uint32_t> at;
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        const Eigen::Vector3f p = -(u * float(x) + v * float(y)) * 0.04f;
        const auto same = std::find_if(mesh.position.begin(), mesh.position.end(),
                                       [&](const Eigen::Vector3f& q) { return (p - q).norm() < 1e-4f; });
        at.push_back(static_cast<std::uint32_t>(same - mesh.position.begin()));
        if (same == mesh.position.end()) mesh.position.push_back(p);
      }
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const auto a = at[std::size_t(y * (n + 1) + x)], b = at[std::size_t(y * (n + 1) + x + 1)],
                   c = at[std::size_t((y + 1) * (n + 1) + x)], d = at[std::size_t((y + 1) * (n + 1) + x + 1)];
        mesh.face.push_back({a, b, d});
        mesh.face.push_back({a, d, c});
      }
  }
  const auto before = test::make_map(mesh, {});
  for (const auto* module : kModules) {
    INFO(module);
    const auto after = simplified(module, before);
    CHECK(after->stats().faces < before->stats().faces / 6);
    for (const auto& chunk : after->table().chunks())
      for (std::size_t f = 0; f < chunk.geometry->face.size(); ++f)
        CHECK(chunk.geometry->face_normal(f).maxCoeff() > 0.999f);
  }
}

TEST_CASE("what has not been seen often enough stays as it is, and no crack opens beside it") {
  const auto before = with_hits(plate(noise), [](const Eigen::Vector3f& p) { return p.x() < 0.5f; });
  auto young = [](const PpmMap& map) {
    std::multiset<std::array<float, 3>> corners;
    for (const auto& chunk : map.table().chunks())
      for (std::size_t f = 0; f < chunk.geometry->face.size(); ++f)
        if (chunk.texels->evidence[f].hits == 0)
          for (auto v : chunk.geometry->face[f]) {
            const auto& p = chunk.geometry->position[v];
            corners.insert({p.x(), p.y(), p.z()});
          }
    return corners;
  };
  for (const auto* module : kModules) {
    INFO(module);
    const auto after = simplified(module, before, "hits_least: 50, sigmas: 0");
    CHECK(after->stats().faces < before->stats().faces);
    CHECK(young(*after) == young(*before));
    CHECK(farthest_apart(*before, *after) < 0.004f);
    const Welding welding = weld(*after, WeldEdges::yes);
    for (const auto& edge : welding.edge)
      if (edge.faces == 1)
        for (auto v : edge.vertex) {
          const auto& p = welding.position[v];
          CHECK(std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()}) < 1e-4f);  // on the rim of the plate
        }
  }
}

TEST_CASE("an open border moves by no more than it may") {
  // A plate with a wavy rim; `border` below the waves keeps them.
  const auto map = plate([](float x, float y) { return 0.3f * std::abs(x - 0.5f) * (y < 0.01f ? 1.0f : 0.0f); });
  for (const auto* module : kModules) {
    INFO(module);
    const auto exact = simplified(module, map, kExact + ", border: 0 m");
    // Corners along straight rims may go even then; the area stays.
    double before = 0, after = 0;
    for (const auto& f : faces_of(*map)) before += (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]).norm();
    for (const auto& f : faces_of(*exact)) after += (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]).norm();
    CHECK(after == Approx(before).epsilon(0.01));
    CHECK(open_edges_of(*exact).size() <= open_edges_of(*map).size());
  }
}

TEST_CASE("a second pass over an unchanged map returns the very same map") {
  for (const auto* module : kModules) {
    Harness h(test::builtin(), module, "{" + kExact + "}");
    h.belief().init(1, Pose::Identity(), plate(noise));
    h.tick();
    const auto once = h.belief().map[0];
    const auto digest = test::digest_of(*once);
    h.tick();
    CHECK(h.belief().map[0] == once);
    CHECK(test::digest_of(*h.belief().map[0]) == digest);
  }
}

TEST_CASE("particles that share a map share its simplification, others keep theirs, for any number of threads") {
  const auto first = plate(noise), second = plate([](float x, float y) { return 0.1f * x * y; });
  const auto before = test::digest_of(*first);
  for (const auto* module : kModules) {
    std::string digests;
    for (int threads : {1, 4}) {
      Harness h(test::builtin(), module, "{" + kExact + "}", threads);
      auto& belief = h.belief();
      belief.init(4, Pose::Identity(), first);
      belief.pose[1].translation().x() = 1;
      belief.map[2] = second;
      h.tick();
      CHECK(belief.map[0] == belief.map[1]);
      CHECK(belief.map[0] != belief.map[2]);
      std::string all;
      for (const auto& map : belief.map) all += test::digest_of(*map);
      if (digests.empty()) digests = all;
      CHECK(all == digests);
    }
    CHECK(test::digest_of(*first) == before);
  }
}

TEST_CASE("after several rounds of new surface, hits and simplification the mesh is sound and the surface where it was") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const auto* module : kModules) {
      INFO(module << " seed " << seed);
      Rng rng(seed, 0, 0, purpose_key("bumps"));
      const auto a = static_cast<float>(10 + 10 * rng.uniform()), b = static_cast<float>(10 * rng.uniform());
      auto map = plate([&](float x, float y) { return 0.03f * std::sin(a * x + b) * std::sin(b * y + a); });
      const auto start = map;
      for (int round = 0; round < 4; ++round) {
        const auto limit = static_cast<float>(rng.uniform());
        map = with_hits(map, [&](const Eigen::Vector3f& p) { return p.y() < limit; });
        const auto before = map;
        map = simplified(module, map, "hits_least: 50, sigmas: 0, error: 3 mm");
        CHECK(farthest_apart(*before, *map) < 0.005f);
      }
      CHECK(map->stats().faces < start->stats().faces);
    }
}

TEST_CASE("colour goes with the surface") {
  PpmSettings settings;
  settings.color_channels = 1;
  PpmEdit edit(std::make_shared<PpmMap>(settings));
  std::vector<std::uint32_t> id;
  std::vector<Eigen::Vector3f> at;
  for (int y = 0; y <= 10; ++y)
    for (int x = 0; x <= 10; ++x) {
      at.emplace_back(0.05f * float(x), 0.05f * float(y), 0.0f);
      id.push_back(edit.add_vertex(at.back()));
    }
  auto face = [&](std::size_t i, std::size_t j, std::size_t k) {
    const std::vector<float> mean(3, 0), variance(3, 1e-5f), gray_variance(3, 0.01f);
    const std::vector<float> gray{at[i].x(), at[j].x(), at[k].x()};  // texels: corner 0, corner 2, corner 1
    const std::vector<float> ordered{gray[0], gray[2], gray[1]};
    edit.add_face({id[i], id[j], id[k]}, 1, {mean, variance, ordered, gray_variance});
  };
  for (std::size_t y = 0; y < 10; ++y)
    for (std::size_t x = 0; x < 10; ++x) {
      const auto k = y * 11 + x;
      face(k, k + 1, k + 12);
      face(k, k + 12, k + 11);
    }
  const MapPointer before = edit.commit();
  for (const auto* module : kModules) {
    const auto after = simplified(module, before);
    CHECK(after->stats().faces < before->stats().faces / 4);
    for (const auto& chunk : after->table().chunks())
      for (std::uint32_t f = 0; f < chunk.geometry->face.size(); ++f) {
        const auto n = std::uint32_t{chunk.geometry->divisions[f]};
        for (std::uint32_t i = 0; i <= n; ++i)
          for (std::uint32_t j = 0; i + j <= n; ++j) {
            const float x = chunk.geometry->point(f, float(i) / float(n), float(j) / float(n)).x();
            CHECK(chunk.texels->color[chunk.geometry->first_texel[f] + texel_index(n, i, j)] ==
                  Approx(x).margin(1e-3));
          }
      }
  }
}
