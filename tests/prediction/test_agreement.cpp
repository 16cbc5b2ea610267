// All back-ends answer the same question: which element each pixel shows, where it is met, and what its texture says.
// A brute-force oracle in double precision decides; where it disagrees with a back-end the pixel must be one that
// rounding decides.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fmt/core.h>
#include <iostream>
#include <map>

#include "framework/core/rng.hpp"
#include "tests/prediction/agreement.hpp"
#include "tests/prediction/agreement_scenes.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

/// Tallies by back-end, over all looks at a scene.
std::map<std::string, Tally> tallies(const Scene& scene, bool cull_back_faces = true) {
  const FaceTree tree(*scene.map, cull_back_faces);
  std::map<std::string, Tally> found;
  for (const auto& backend : exact_backends()) {
    Viewer viewer(backend, scene.map);
    for (Look look : scene.looks) {
      look.cull_back_faces = cull_back_faces;
      found[backend].add(judge(*scene.map, tree, *viewer.see(look)));
    }
  }
  return found;
}

void check(const Scene& scene, bool cull_back_faces = true) {
  for (const auto& [backend, tally] : tallies(scene, cull_back_faces)) {
    INFO(backend << ", " << scene.name << ": " << tally.first_fault);
    CHECK(tally.of(Verdict::fault) == 0);
    CHECK(tally.doubtful() <= scene.doubtful);
    CHECK(tally.range <= 1);
    CHECK(tally.point <= 1);
    CHECK(tally.normal <= 1);
    CHECK(tally.mean <= 1);
    CHECK(tally.variance <= 1);
    CHECK(tally.color <= 1);
    CHECK(tally.hits > 0);
  }
}

}  // namespace

TEST_CASE("back-ends agree with the oracle on shaped surfaces") {
  for (const Scene& scene : shaped_scenes()) check(scene);
}

TEST_CASE("back-ends agree with the oracle on soups of triangles") {
  for (const Scene& scene : soups()) check(scene);
}

TEST_CASE("back-ends agree with the oracle where faces seen from behind are hit") {
  check(shaped_scenes().front(), false);
  for (const Scene& scene : soups()) check(scene, false);
}

TEST_CASE("back-ends agree with the oracle on a map of the embedded room, in colour") {
  check(mapped_room());
}

TEST_CASE("back-ends agree with the oracle on a map of kitchen") {
  if (const auto kitchen = mapped_kitchen()) check(*kitchen);
}

TEST_CASE("a view that is wrong is a fault") {
  const Scene scene = shaped_scenes().front();
  const FaceTree tree(*scene.map);
  const Look& look = scene.looks.front();
  Viewer viewer(exact_backends().front(), scene.map);
  const Prediction right = *viewer.see(look);
  const std::size_t p = right.range.size() / 2;
  REQUIRE(right.hit(p));
  REQUIRE(right.face[p] != right.face[0]);
  const auto judged = [&](auto spoil) {
    Prediction wrong = right;
    spoil(wrong);
    return judge(*scene.map, tree, wrong);
  };
  CHECK(judged([](Prediction&) {}).of(Verdict::fault) == 0);
  CHECK(judged([&](Prediction& v) { v.chunk[p] = v.chunk[0], v.face[p] = v.face[0]; }).of(Verdict::fault) == 1);
  CHECK(judged([&](Prediction& v) { v.chunk[p] = Prediction::kNone; }).of(Verdict::fault) == 1);
  CHECK(judged([&](Prediction& v) { v.range[p] += 1e-3f; }).range > 1);
  CHECK(judged([&](Prediction& v) { v.bary[2 * p] += 1e-3f; }).point > 1);
  CHECK(judged([&](Prediction& v) { v.normal[3 * p] += 1e-3f; }).normal > 1);
  CHECK(judged([&](Prediction& v) { v.mean[p] += 1e-5f; }).mean > 1);
  CHECK(judged([&](Prediction& v) { v.variance[p] *= 1.001f; }).variance > 1);
  // A twentieth of a pixel is seen on edges.
  Look beside = look;
  beside.camera.cx += 0.05;
  Prediction moved = *viewer.see(beside);
  moved.camera = right.camera;
  CHECK(judge(*scene.map, tree, moved).of(Verdict::fault) > 10);
}

TEST_CASE("the oracle's tree of boxes finds what trying every triangle finds") {
  const bool cull = GENERATE(true, false);
  for (const Scene& scene : soups()) {
    const FaceTree tree(*scene.map, cull);
    Rng rng(3, 0, 0, purpose_key("rays"));
    for (int i = 0; i < 100; ++i) {
      const double x = rng.normal(), y = rng.normal(), z = rng.normal();
      const Eigen::Vector3d origin = 0.1 * Eigen::Vector3d(y, z, x), direction = Eigen::Vector3d(x, y, z).normalized();
      const auto all = all_hits(*scene.map, origin, direction, cull, 0);
      const auto exact = nearest_hit(all), found = tree.nearest(origin, direction);
      CHECK(tree.all(origin, direction).size() == all.size());
      CHECK(found.range == exact.range);
      CHECK(found.chunk == exact.chunk);
      CHECK(found.face == exact.face);
    }
  }
}

// Prints the table of docs/results/views.md: ask for it by its tag.
TEST_CASE("table of agreement", "[.table]") {
  std::cout << "| scene | back-end | pixels | hits | same | tie | edge | sliver | close | faults | largest error / "
               "tolerated |\n";
  std::cout << "|---|---|---|---|---|---|---|---|---|---|---|\n";
  std::map<std::pair<std::string, std::string>, Tally> rows;
  std::vector<std::string> order;
  auto scenes = shaped_scenes();
  for (auto& scene : soups()) scenes.push_back(std::move(scene));
  scenes.push_back(mapped_room());
  if (auto kitchen = mapped_kitchen()) scenes.push_back(std::move(*kitchen));
  for (const Scene& scene : scenes) {
    if (std::find(order.begin(), order.end(), scene.name) == order.end()) order.push_back(scene.name);
    for (const auto& [backend, tally] : tallies(scene)) rows[{scene.name, backend}].add(tally);
  }
  for (const auto& scene : order)
    for (const auto& backend : exact_backends()) {
      const Tally& t = rows[{scene, backend}];
      std::cout << fmt::format("| {} | `{}` | {} | {} |", scene, backend, t.pixels, t.hits);
      for (std::size_t count : t.count) std::cout << fmt::format(" {} |", count);
      std::cout << fmt::format(" {:.2f} |\n", t.worst_error());
    }
}
