#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "framework/core/error.hpp"
#include "framework/slam/belief_digest.hpp"
#include "framework/slam/belief_file.hpp"
#include "framework/slam/map_memory.hpp"
#include "tests/support/block_maps.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

constexpr std::string_view kMagic = "PPMTEST\n";

MapCodecs codecs() {
  return {{"block", std::make_shared<BlockCodec>()}};
}

Pose shifted(double x) {
  return Pose(Eigen::Translation3d(x, 0, 0));
}

/// A belief whose particles descend from each other: shared maps, shared pasts, two typed columns.
ParticleSet family(int frames) {
  std::mt19937 random(3);
  ParticleSet belief;
  belief.init(9, shifted(1), block_map(0));
  belief.T_map_world = shifted(-2);
  auto& velocity = belief.column<Eigen::Vector3d>("test/velocity");
  auto& name = belief.column<std::string>("test/name");
  for (int frame = 0; frame < frames; ++frame) {
    for (std::size_t i = 0; i < belief.size(); ++i) {
      belief.extend(i, {frame, 0.1 * frame, shifted(static_cast<double>(random() % 100))});
      velocity[i].setConstant(static_cast<double>(random() % 100));
      name[i] += static_cast<char>('a' + random() % 26);
      belief.log_weight[i] -= 0.1 * static_cast<double>(random() % 10);
      if (random() % 3 == 0) belief.map[i] = grown(belief.map[i], frame);
    }
    belief.normalize();
    std::vector<std::uint32_t> ancestors(9);
    for (auto& a : ancestors) a = static_cast<std::uint32_t>(random() % 9);
    belief.gather(ancestors);
  }
  return belief;
}

void save_to(const std::filesystem::path& file, const ParticleSet& belief, bool predictions = false) {
  RecordFileWriter out(file, kMagic);
  save_belief(belief, codecs(), predictions, out);
  out.commit();
}

ParticleSet load_from(const std::filesystem::path& file) {
  RecordFileReader in(file, kMagic, "a belief");
  ParticleSet belief;
  load_belief(belief, codecs(), in);
  in.finish("the maps");
  return belief;
}

/// How many nodes the paths occupy together.
std::size_t distinct_nodes(const ParticleSet& belief) {
  std::set<const void*> seen;
  for (const auto& path : belief.trajectory)
    for (auto at = path; !at.empty(); at = at.parent()) seen.insert(at.identity());
  return seen.size();
}

}  // namespace

TEST_CASE("a belief comes back from its file: the same digest, the same sharing, the same columns") {
  TempFolder folder;
  auto before = family(30);
  save_to(folder / "belief.bin", before);
  auto after = load_from(folder / "belief.bin");

  const Workers workers(1);
  CHECK(belief_digest(after, workers) == belief_digest(before, workers));
  CHECK(after.T_map_world->matrix() == before.T_map_world->matrix());
  CHECK(distinct_nodes(after) == distinct_nodes(before));
  CHECK(map_memory(after).together == map_memory(before).together);
  CHECK(map_memory(after).alone == map_memory(before).alone);
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t j = 0; j < 9; ++j) {
      CHECK((after.map[i] == after.map[j]) == (before.map[i] == before.map[j]));
      CHECK((after.trajectory[i] == after.trajectory[j]) == (before.trajectory[i] == before.trajectory[j]));
    }
    CHECK(after.column<Eigen::Vector3d>("test/velocity")[i] == before.column<Eigen::Vector3d>("test/velocity")[i]);
    CHECK(after.column<std::string>("test/name")[i] == before.column<std::string>("test/name")[i]);
  }
}

TEST_CASE("a column that nobody has asked for yet moves with its particles, and survives another file") {
  TempFolder folder;
  save_to(folder / "belief.bin", family(3));
  auto belief = load_from(folder / "belief.bin");
  auto expected = family(3);
  for (auto* b : {&belief, &expected}) b->gather({8, 0, 0, 5});
  save_to(folder / "again.bin", belief);
  auto again = load_from(folder / "again.bin");
  CHECK(again.column<std::string>("test/name").values == expected.column<std::string>("test/name").values);
  CHECK_THROWS_WITH(again.column<int>("test/velocity"), Contains("again.bin") && Contains("column 'test/velocity'"));

  belief.init(6, Pose::Identity(), nullptr);  // four values are there, two are new
  CHECK(belief.column<std::string>("test/name")[3] == expected.column<std::string>("test/name")[3]);
  CHECK(belief.column<std::string>("test/name")[5].empty());
}

TEST_CASE("predictions are kept where asked for, shared as they were") {
  TempFolder folder;
  auto belief = family(2);
  auto view = std::make_shared<Prediction>();
  view->reset({8, 6, 5, 5, 4, 3}, 2, shifted(4));
  view->range[3] = 1.25f;
  belief.prediction[1] = belief.prediction[4] = view;
  save_to(folder / "with.bin", belief, true);
  const auto with = load_from(folder / "with.bin");
  REQUIRE(with.prediction[1]);
  CHECK(with.prediction[1] == with.prediction[4]);
  CHECK(with.prediction[1]->range == view->range);
  CHECK(with.prediction[1]->camera == view->camera);
  CHECK(with.prediction[1]->T_map_camera.matrix() == view->T_map_camera.matrix());
  CHECK_FALSE(with.prediction[0]);
  save_to(folder / "without.bin", belief);
  CHECK_FALSE(load_from(folder / "without.bin").prediction[1]);
}

TEST_CASE("a belief without particles, and one without maps, come back") {
  TempFolder folder;
  save_to(folder / "empty.bin", ParticleSet());
  CHECK(load_from(folder / "empty.bin").size() == 0);
  ParticleSet bare;
  bare.init(2, shifted(3), nullptr);
  bare.T_map_world.reset();
  save_to(folder / "bare.bin", bare);
  const auto back = load_from(folder / "bare.bin");
  CHECK(back.pose[1].translation().x() == 3);
  CHECK(back.map[0] == nullptr);
  CHECK_FALSE(back.T_map_world);
}

TEST_CASE("maps of a kind without a codec are refused, in saving and in loading") {
  TempFolder folder;
  auto belief = family(2);
  RecordFileWriter out(folder / "belief.bin", kMagic);
  CHECK_THROWS_WITH(save_belief(belief, {}, false, out), Contains("maps of kind 'block' cannot be kept"));
  save_to(folder / "belief.bin", belief);
  RecordFileReader in(folder / "belief.bin", kMagic, "a belief");
  ParticleSet read;
  CHECK_THROWS_WITH(load_belief(read, {}, in), Contains("kind 'block'"));
}
