#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numeric>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/texel_resample.hpp"

namespace {

using namespace ppm;
using Corners = std::array<Eigen::Vector3f, 3>;

/// Faces that own their texels.
struct Patch {
  std::vector<TexelArrays> texels;
  std::vector<TexturedFace> faces;

  /// height: of the described surface over the xy plane, m, at x, y. Faces lie in the plane z = base(x, y).
  void add(const Corners& corner, std::uint32_t n, const std::function<float(const Eigen::Vector3f&)>& mean,
           const std::function<float(const Eigen::Vector3f&)>& variance, FaceEvidence evidence = {}) {
    TexelArrays t;
    for (std::uint32_t i = 0; i <= n; ++i)
      for (std::uint32_t j = 0; i + j <= n; ++j) {
        const float u = static_cast<float>(i) / static_cast<float>(n),
                    v = static_cast<float>(j) / static_cast<float>(n);
        const Eigen::Vector3f p = corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]);
        t.mean.push_back(mean(p));
        t.variance.push_back(variance(p));
      }
    texels.push_back(std::move(t));
    faces.push_back({corner, n, evidence, {}});
  }
  std::span<const TexturedFace> view() {
    for (std::size_t f = 0; f < faces.size(); ++f) faces[f].texels = texels[f].view(0, texels[f].size());
    return faces;
  }
};

/// A square [0, size]^2 of n x n squares at the height `base`, free space above; `add` gets each triangle's corners.
void grid(int n, float size, const std::function<float(float, float)>& base,
          const std::function<void(const Corners&)>& add) {
  auto at = [&](int x, int y) {
    const float px = size * static_cast<float>(x) / static_cast<float>(n),
                py = size * static_cast<float>(y) / static_cast<float>(n);
    return Eigen::Vector3f(px, py, base(px, py));
  };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      add({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      add({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
}
float flat(float, float) {
  return 0;
}
std::function<float(const Eigen::Vector3f&)> always(float value) {
  return [value](const Eigen::Vector3f&) { return value; };
}

float area_of(const Corners& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2;
}

/// Integral of 1 / variance over a face, each node standing for a third of its triangles.
double information(const Corners& corner, std::uint32_t n, std::span<const float> variance) {
  double sum = 0;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; i + j <= n; ++j) {
      const int sides = (i == 0) + (j == 0) + (i + j == n);
      sum += (sides == 0 ? 6 : sides == 1 ? 3 : 1) / static_cast<double>(variance[texel_index(n, i, j)]);
    }
  return sum * area_of(corner) / (3.0 * n * n);
}

/// Where a line meets the triangles between displaced texels, by trying all.
std::vector<float> meet_all(std::span<const TexturedFace> faces, const Eigen::Vector3d& origin,
                            const Eigen::Vector3d& direction) {
  std::vector<float> found;
  for (const auto& f : faces) {
    const Eigen::Vector3d p = f.corner[0].cast<double>(), e1 = f.corner[1].cast<double>() - p,
                          e2 = f.corner[2].cast<double>() - p, normal = e1.cross(e2).normalized();
    const auto n = f.divisions;
    auto node = [&](std::uint32_t i, std::uint32_t j) -> Eigen::Vector3d {
      return p + e1 * i / n + e2 * j / n + normal * static_cast<double>(f.texels.mean[texel_index(n, i, j)]);
    };
    auto meet = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
      Eigen::Matrix3d m;
      m << b - a, c - a, -direction;
      const Eigen::Vector3d x = m.partialPivLu().solve(origin - a);
      if (x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1) found.push_back(static_cast<float>(x[2]));
    };
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; i + j < n; ++j) {
        meet(node(i, j), node(i + 1, j), node(i, j + 1));
        if (i + j + 2 <= n) meet(node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
      }
  }
  return found;
}

/// A wavy base under texels that wave too.
Patch wavy(int n) {
  Patch patch;
  grid(n, 0.4f, [](float x, float y) { return 0.01f * std::sin(9 * x + 2) * std::cos(7 * y); }, [&](const Corners& c) {
    patch.add(
        c, 3, [](const Eigen::Vector3f& p) { return 0.004f * std::sin(25 * p.x()) * std::sin(31 * p.y() + 1); },
        [](const Eigen::Vector3f& p) { return 1e-5f * (1.5f + std::sin(20 * p.x() + 10 * p.y())); }, {40, 3, 2e-5f});
  });
  return patch;
}

const Corners kHalves[2] = {{Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0.4f, 0, 0), Eigen::Vector3f(0.4f, 0.4f, 0)},
                            {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0.4f, 0.4f, 0), Eigen::Vector3f(0, 0.4f, 0)}};

}  // namespace

TEST_CASE("a line meets the described surface where the displaced triangles say, by trying all") {
  auto patch = wavy(8);
  DescribedSurface surface(patch.view());
  const Eigen::Vector3f normal = Eigen::Vector3f(0.2f, -0.1f, 1).normalized();
  const CastPlane plane{{0.02f, 0.02f, 0.005f}, {0.35f, 0, -0.07f}, {0, 0.35f, 0.035f}, normal};
  surface.aim(plane, 0.1f);
  Rng rng(3, 0, 0, purpose_key("lines"));
  int met = 0, missed = 0;
  for (int k = 0; k < 2000; ++k) {
    const auto a = static_cast<float>(rng.uniform()), b = static_cast<float>(rng.uniform());
    if (a + b > 1) continue;
    const Eigen::Vector3f origin = plane.origin + a * plane.edge1 + b * plane.edge2;
    const auto all = meet_all(patch.faces, origin.cast<double>(), normal.cast<double>());
    const auto hit = surface.cast(a, b);
    if (hit.miss > 0) {  // the gap at a fold
      CHECK(hit.miss < 0.002f);
      ++missed;
      continue;
    }
    ++met;
    REQUIRE(!all.empty());
    float nearest = 1;
    for (float t : all) nearest = std::min(nearest, std::abs(t - hit.offset));
    CHECK(nearest < 2e-5f);
  }
  CHECK(met > 900);
  CHECK(missed < 0.03 * met);
}

TEST_CASE("seen along a line, the surface stands off the face that the line meets") {
  auto patch = wavy(8);
  DescribedSurface surface(patch.view(), Meeting::seen);
  const Eigen::Vector3f normal = Eigen::Vector3f(0.2f, -0.1f, 1).normalized();
  const CastPlane plane{{0.02f, 0.02f, 0.005f}, {0.35f, 0, -0.07f}, {0, 0.35f, 0.035f}, normal};
  surface.aim(plane, 0.1f);
  Rng rng(3, 0, 0, purpose_key("lines"));
  for (int k = 0; k < 1000; ++k) {
    const auto a = static_cast<float>(0.5 * rng.uniform()), b = static_cast<float>(0.5 * rng.uniform());
    const auto hit = surface.cast(a, b);
    REQUIRE(hit.miss == 0);  // no gaps at folds
    const auto& f = patch.faces[hit.face];
    const Eigen::Vector3d p = f.corner[0].cast<double>(), e1 = f.corner[1].cast<double>() - p,
                          e2 = f.corner[2].cast<double>() - p, d = normal.cast<double>();
    Eigen::Matrix3d m;
    m << e1, e2, -d;
    const Eigen::Vector3d x =
        m.partialPivLu().solve((plane.origin + a * plane.edge1 + b * plane.edge2).cast<double>() - p);
    CHECK((x[0] > -1e-3 && x[1] > -1e-3 && x[0] + x[1] < 1.001));
    const auto t = texel_triangle(f.divisions, static_cast<float>(x[0]), static_cast<float>(x[1]));
    float mean = 0;
    for (int i = 0; i < 3; ++i) mean += t.weight[i] * f.texels.mean[t.texel[i]];
    CHECK(hit.offset == Approx(x[2] + mean / e1.cross(e2).normalized().dot(d)).margin(1e-5));
  }
}

TEST_CASE("a face resampled from itself stays as it is") {
  Patch patch;
  const Corners c{Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(1.07f, 2, 3), Eigen::Vector3f(1, 2.06f, 3.02f)};
  PpmSettings settings;
  const auto n = PpmMap(settings).divisions_for(c[0], c[1], c[2]);
  Rng rng(5, 0, 0, purpose_key("texels"));
  patch.add(
      c, n, [&](const Eigen::Vector3f&) { return static_cast<float>(0.003 * rng.normal()); }, always(2e-5f),
      {100, 7, 3e-5f});
  const auto faces = resample_faces(patch.view(), std::vector{c}, settings);
  REQUIRE(faces[0].divisions == n);
  for (std::size_t t = 0; t < texel_count(n); ++t) {
    CHECK(faces[0].texels.mean[t] == Approx(patch.texels[0].mean[t]).margin(3e-6));
    CHECK(faces[0].texels.variance[t] == Approx(2e-5f));
  }
  CHECK(faces[0].evidence.hits == 100);
  CHECK(faces[0].evidence.through == 7);
  CHECK(faces[0].evidence.excess == Approx(3e-5f));
}

TEST_CASE("a face resampled among neighbours that say otherwise at its edges stays as it is") {
  Patch patch;
  Rng rng(6, 0, 0, purpose_key("texels"));
  PpmSettings settings;
  grid(4, 0.2f, [](float x, float y) { return 0.02f * std::sin(20 * x) * std::cos(17 * y); }, [&](const Corners& c) {
    const auto n = PpmMap(settings).divisions_for(c[0], c[1], c[2]);
    patch.add(
        c, n, [&](const Eigen::Vector3f&) { return static_cast<float>(0.004 * rng.normal()); }, always(2e-5f));
  });
  TexelResampler resampler(patch.view(), settings, Meeting::seen);
  for (std::size_t f = 0; f < patch.faces.size(); ++f) {
    const auto face = resampler.resample(patch.faces[f].corner);
    REQUIRE(face.divisions == patch.faces[f].divisions);
    REQUIRE(face.overlap.size() == 1);
    CHECK(face.overlap[0].old_face == f);
    for (std::size_t t = 0; t < face.texels.size(); ++t)
      CHECK(face.texels.mean[t] == Approx(patch.texels[f].mean[t]).margin(5e-6));
  }
}

TEST_CASE("a tilted plane described by many faces is described as well by two, whatever way they tilt") {
  Patch patch;
  auto plane = [](float x, float y) { return 0.1f * x - 0.05f * y + 0.01f; };
  grid(7, 0.4f, plane, [&](const Corners& c) { patch.add(c, 2, always(0), always(1e-5f)); });
  PpmSettings settings;
  for (const auto& half : kHalves) {
    const auto face = TexelResampler(patch.view(), settings).resample(half, {0.001f, 0});
    CHECK(face.error.distance < 2e-5f);
    CHECK(face.error.share < 0.02f);
    const auto n = std::uint32_t{face.divisions};
    for (std::uint32_t i = 0; i <= n; ++i)
      for (std::uint32_t j = 0; i + j <= n; ++j) {
        const Eigen::Vector3f p = half[0] + (half[1] - half[0]) * (static_cast<float>(i) / static_cast<float>(n)) +
                                  (half[2] - half[0]) * (static_cast<float>(j) / static_cast<float>(n));
        CHECK(face.texels.mean[texel_index(n, i, j)] == Approx(plane(p.x(), p.y())).margin(3e-5));
      }
  }
}

TEST_CASE("the described surface is the same before and after, by brute force, and information is conserved") {
  auto patch = wavy(16);
  std::vector<Corners> corners;
  grid(3, 0.4f, flat, [&](const Corners& c) { corners.push_back(c); });
  PpmSettings settings;
  settings.texel_size_m = 0.015;
  const auto faces = resample_faces(patch.view(), corners, settings);

  double before = 0, after = 0, hits = 0;
  for (const auto& f : patch.faces) before += information(f.corner, f.divisions, f.texels.variance);
  Patch next;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    after += information(corners[f], faces[f].divisions, faces[f].texels.variance);
    hits += faces[f].evidence.hits;
    CHECK(faces[f].evidence.excess == Approx(2e-5f));
    next.faces.push_back({corners[f], faces[f].divisions, {}, faces[f].view()});
  }
  CHECK(after == Approx(before).epsilon(0.01));
  CHECK(hits == Approx(40.0 * static_cast<double>(patch.faces.size())).epsilon(0.03));

  Rng rng(9, 0, 0, purpose_key("lines"));
  double squares = 0;
  int lines = 0;
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector3d origin(0.02 + 0.36 * rng.uniform(), 0.02 + 0.36 * rng.uniform(), 0);
    const auto was = meet_all(patch.faces, origin, Eigen::Vector3d::UnitZ()),
               is = meet_all(next.faces, origin, Eigen::Vector3d::UnitZ());
    if (was.empty() || is.empty()) continue;
    squares += std::pow(was[0] - is[0], 2);
    CHECK(std::abs(was[0] - is[0]) < 0.002f);
    ++lines;
  }
  CHECK(lines > 900);
  CHECK(std::sqrt(squares / lines) < 0.0004);
}

TEST_CASE("coarser texels take the mean over their area, weighted by information") {
  Patch patch;
  // Fine texels that alternate between two values, one known ten times better than the other.
  int k = 0;
  grid(40, 0.4f, flat, [&](const Corners& c) {
    const bool odd = (k++ / 2) % 2 == 1;
    patch.add(c, 1, always(odd ? 0.002f : 0.0f), always(odd ? 1e-6f : 1e-5f));
  });
  PpmSettings settings;
  settings.texel_size_m = 0.1;
  double sum = 0;
  std::size_t count = 0;
  for (const auto& f : resample_faces(patch.view(), std::vector<Corners>(kHalves, kHalves + 2), settings)) {
    for (float m : f.texels.mean) sum += m;
    for (float v : f.texels.variance) CHECK((v > 0.99e-6f && v < 1.01e-5f));
    count += f.texels.size();
  }
  CHECK(sum / static_cast<double>(count) > 0.0010);
}

TEST_CASE("texels that were never observed keep the prior's variance") {
  Patch patch;
  PpmSettings settings;
  const auto prior = static_cast<float>(settings.prior_sigma_m * settings.prior_sigma_m);
  grid(8, 0.4f, flat, [&](const Corners& c) {
    patch.add(c, 2, always(0), [&](const Eigen::Vector3f& p) { return p.x() > 0.2f ? prior : 1e-5f; });
  });
  for (const auto& half : kHalves) {
    const auto face = TexelResampler(patch.view(), settings).resample(half);
    const auto n = std::uint32_t{face.divisions};
    for (std::uint32_t i = 0; i <= n; ++i)
      for (std::uint32_t j = 0; i + j <= n; ++j) {
        const float x = half[0].x() + (half[1] - half[0]).x() * static_cast<float>(i) / static_cast<float>(n) +
                        (half[2] - half[0]).x() * static_cast<float>(j) / static_cast<float>(n);
        const float v = face.texels.variance[texel_index(n, i, j)];
        if (x > 0.26f) CHECK(v == Approx(prior).epsilon(1e-3));
        if (x < 0.17f) CHECK(v * 1e5f == Approx(1).epsilon(0.05));
      }
  }
}

TEST_CASE("colour is resampled where the surface is, and keeps its variance") {
  Patch patch;
  auto red = [](float x) { return 0.2f + x; };
  grid(8, 0.4f, flat, [&](const Corners& c) { patch.add(c, 2, always(0), always(1e-5f)); });
  for (std::size_t f = 0; f < patch.faces.size(); ++f) {
    auto& t = patch.texels[f];
    const auto& c = patch.faces[f].corner;
    for (std::uint32_t i = 0; i <= 2; ++i)
      for (std::uint32_t j = 0; i + j <= 2; ++j) {
        const Eigen::Vector3f p = c[0] + (c[1] - c[0]) * (static_cast<float>(i) / 2) + (c[2] - c[0]) * (static_cast<float>(j) / 2);
        t.color.insert(t.color.end(), {red(p.x()), 0.5f, 0.9f});
        t.color_variance.push_back(0.01f);
      }
  }
  PpmSettings settings;
  settings.color_channels = 3;
  const auto face = TexelResampler(patch.view(), settings).resample(kHalves[0]);
  const auto n = std::uint32_t{face.divisions};
  REQUIRE(face.texels.color.size() == 3 * texel_count(n));
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; i + j <= n; ++j) {
      const auto t = texel_index(n, i, j);
      const float x = 0.4f * static_cast<float>(i + j) / static_cast<float>(n);
      CHECK(face.texels.color[3 * t] == Approx(red(x)).margin(1e-4));
      CHECK(face.texels.color[3 * t + 2] == Approx(0.9f));
      CHECK(face.texels.color_variance[t] == Approx(0.01f));
    }
}

TEST_CASE("a face that stands across the old surface, or beside it, says so") {
  Patch patch;
  grid(4, 0.4f, flat, [&](const Corners& c) { patch.add(c, 2, always(0), always(1e-5f)); });
  PpmSettings settings;
  TexelResampler resampler(patch.view(), settings);
  const Corners upright{Eigen::Vector3f(0.1f, 0.1f, 0), Eigen::Vector3f(0.2f, 0.1f, 0), Eigen::Vector3f(0.1f, 0.1f, 0.1f)};
  CHECK(std::isinf(resampler.resample(upright).error.miss));
  const Corners over{Eigen::Vector3f(0.35f, 0.1f, 0), Eigen::Vector3f(0.45f, 0.1f, 0), Eigen::Vector3f(0.35f, 0.2f, 0)};
  CHECK(resampler.resample(over).error.miss == Approx(0.05f).margin(1e-4));
}
