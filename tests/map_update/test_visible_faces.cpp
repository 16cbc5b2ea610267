#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "modules/maps/ppm/visible_faces.hpp"
#include "tests/map_update/mapper.hpp"
#include "tests/map_update/views.hpp"
#include "tests/support/ppm_maps.hpp"
#include "tests/support/simd_targets.hpp"

using namespace ppm;
using namespace ppm::test;

TEST_CASE("visible faces are those of the view's pixels, each once and ascending, view after view") {
  PpmSettings settings;
  settings.cell_size_m = 0.3;
  Mapper mapper({}, settings);
  const BoxWorld scene;
  for (std::uint32_t i = 0; i < 4; ++i)
    mapper.add(scene.frame(small_camera(), look({0, 0, 0}, 0.2 * i), 0.004, i, true));
  VisibleFaces seen;
  for (double yaw : {0.0, 0.3, 0.7}) {
    const Pose pose = look({0, 0, 0}, yaw);
    Frame frame = scene.frame(small_camera(), pose, 0.004, 9, true);
    for (std::size_t p = 0; p < 1000; ++p) frame.depth[p] = NAN;
    const Prediction view = mapper.predict(small_camera(), pose);
    std::map<std::uint32_t, std::set<std::uint32_t>> expected;
    std::size_t missed = 0, measured = 0;
    for (std::size_t p = 0; p < view.chunk.size(); ++p) {
      measured += frame.depth[p] == frame.depth[p];
      missed += frame.depth[p] == frame.depth[p] && !view.hit(p);
      if (view.hit(p)) expected[view.chunk[p]].insert(view.face[p]);
    }
    seen.collect(mapper.map(), view, frame);
    CHECK(seen.parts().size() == expected.size());
    for (const auto& part : seen.parts()) {
      const auto& faces = expected[part.chunk];
      CHECK(std::vector<std::uint32_t>(part.faces.begin(), part.faces.end()) ==
            std::vector<std::uint32_t>(faces.begin(), faces.end()));
    }
    CHECK(seen.miss_share() == Approx(static_cast<double>(missed) / static_cast<double>(measured)));
    CHECK(missed > 0);
  }
}

TEST_CASE("visible faces are the same on every instruction set") {
  Mapper mapper;
  const BoxWorld scene;
  const Frame frame = scene.frame(small_camera(), look({0, 0, 0}), 0.004, 0, true);
  mapper.add(frame);
  const int stride = GENERATE(1, 2);
  const Prediction view = mapper.predict(small_camera(), look({0, 0, 0}, 0.2), stride);
  std::set<std::vector<std::uint32_t>> lists;
  std::set<double> shares;
  on_every_target([&] {
    VisibleFaces seen;
    seen.collect(mapper.map(), view, frame);
    std::vector<std::uint32_t> list;
    for (const auto& part : seen.parts()) {
      list.push_back(part.chunk);
      list.insert(list.end(), part.faces.begin(), part.faces.end());
    }
    lists.insert(list);
    shares.insert(seen.miss_share());
  });
  CHECK(lists.size() == 1);
  CHECK(shares.size() == 1);
  CHECK(*shares.begin() > 0);
}

TEST_CASE("an image without measurements misses nothing") {
  Mapper mapper;
  const Frame blind = frame_of([](int, int) { return NAN; });
  VisibleFaces seen;
  seen.collect(mapper.map(), mapper.predict(small_camera(), Pose::Identity()), blind);
  CHECK(seen.parts().empty());
  CHECK(seen.miss_share() == 0);
}
