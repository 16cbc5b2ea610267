#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <limits>
#include <thread>

#include "framework/core/error.hpp"
#include "framework/graph/harness.hpp"
#include "framework/roles/frame_source.hpp"

namespace {

using Catch::Matchers::Contains;
using Indices = std::vector<std::int64_t>;

/// What is special about a sequence of images; -1 = nothing.
struct Toy {
  std::int64_t images = 10, broken = -1, nan_pose = -1, sheared_pose = -1, no_pose = -1, repeated_stamp = -1;
  int read_ms = 0;
  std::atomic<int>* reads = nullptr;
};

/// Images of 4x2 pixels whose depth is 1 + index / 10.
class ToySequence final : public ppm::FrameSequence {
 public:
  explicit ToySequence(const Toy& toy) : toy_(toy) {}
  std::string name() const override { return "toy/folder"; }
  std::int64_t size() const override { return toy_.images; }
  double stamp_s(std::int64_t i) const override {
    return 0.1 * static_cast<double>(i == toy_.repeated_stamp ? i - 1 : i);
  }
  std::optional<ppm::Pose> reference_pose(std::int64_t i) const override {
    if (i == toy_.no_pose) return std::nullopt;
    ppm::Pose T = ppm::Pose::Identity();
    T.translation().x() = i == toy_.nan_pose ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(i);
    if (i == toy_.sheared_pose) T.linear()(0, 1) = 0.5;
    return T;
  }
  ppm::Frame read(std::int64_t i) const override {
    if (toy_.reads) ++*toy_.reads;
    std::this_thread::sleep_for(std::chrono::milliseconds(toy_.read_ms));
    if (i == toy_.broken) throw ppm::DataError("toy/folder/image.png", i, "cut short");
    ppm::Frame f;
    f.index = i;
    f.stamp_s = stamp_s(i);
    f.camera = {4, 2, 4, 4, 1.5, 0.5};
    f.depth.assign(8, 1.0f + 0.1f * static_cast<float>(i));
    return f;
  }
  /// One sample, which says since when.
  void add_motion(double after_s, ppm::Frame& image) const override {
    image.imu = {{image.stamp_s, Eigen::Vector3d::Constant(after_s), Eigen::Vector3d::Zero()}};
  }

 private:
  Toy toy_;
};

class ToySource final : public ppm::FrameSource {
 public:
  explicit ToySource(const Toy& toy) : toy_(toy) {}
  std::unique_ptr<const ppm::FrameSequence> open_sequence() const override {
    return std::make_unique<ToySequence>(toy_);
  }

 private:
  Toy toy_;
};

ppm::Registry registry_of(const Toy& toy) {
  ppm::Registry r;
  r.add({"source.toy", "A few small images.", "made up", "test", [toy] { return std::make_unique<ToySource>(toy); }});
  return r;
}

struct ToyRun {
  explicit ToyRun(const std::string& params, const Toy& toy = {}) : h(registry_of(toy), "source.toy", params) {}
  ppm::FrameSource& source() { return dynamic_cast<ppm::FrameSource&>(h.module()); }
  /// Indices of the frames up to the end or the first error, whose text goes to `error`.
  Indices run(std::string* error = nullptr) {
    Indices seen;
    try {
      while (h.tick()) seen.push_back(h.output<ppm::Frame>("frame")->index);
    } catch (const ppm::DataError& e) {
      if (!error) throw;
      *error = e.what();
    }
    return seen;
  }
  ppm::Harness h;
};

}  // namespace

TEST_CASE("a source gives the selected images in order, then ends") {
  CHECK(ToyRun("{}").run() == Indices{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(ToyRun("{first: 2, last: 8, stride: 3}").run() == Indices{2, 5, 8});
  ToyRun held("{holdout: every 4th}");
  CHECK(held.run() == Indices{0, 1, 3, 4, 5, 7, 8, 9});
  CHECK(held.source().held_out() == Indices{2, 6});
  CHECK(held.source().selected().size() == 8);
}

TEST_CASE("held-out images that are followed come in their place, marked, from the first mapped one on") {
  auto given = [](const std::string& params) {
    ToyRun toy(params + ", held_out: followed}");
    Indices frames;
    while (toy.h.tick()) {
      const auto frame = toy.h.output<ppm::Frame>("frame");
      frames.push_back(frame->held_out ? -frame->index : frame->index);
    }
    Indices reference;
    for (const auto& p : toy.source().reference()) reference.push_back(p.frame);
    CHECK(reference.size() == frames.size());
    return frames;
  };
  CHECK(given("{holdout: every 4th") == Indices{0, 1, -2, 3, 4, 5, -6, 7, 8, 9});
  CHECK(given("{holdout: every 4th, first: 2") == Indices{3, 4, 5, -6, 7, 8, 9});
  CHECK(given("{holdout: every 4th, stride: 5") == Indices{0, -2, 5, -6});
  CHECK(given("{last: 2") == Indices{0, 1, 2});
  ToyRun left_out("{holdout: every 4th}");
  while (left_out.h.tick()) CHECK_FALSE(left_out.h.output<ppm::Frame>("frame")->held_out);
}

TEST_CASE("frames carry decimated images, held-out ones keep every pixel") {
  ToyRun toy("{pixel_stride: 2, holdout: every 4th, max_range: 1.5 m}");
  REQUIRE(toy.h.tick());
  const auto frame = toy.h.output<ppm::Frame>("frame");
  CHECK(frame->camera.cols == 2);
  CHECK(frame->camera.rows == 1);
  CHECK(frame->T_world_camera_ref->translation().x() == 0);
  const auto full = toy.source().full_frame(2);
  CHECK(full.camera.cols == 4);
  CHECK(full.index == 2);
  CHECK(full.sigma[0] > 0);
  CHECK_FALSE(toy.source().full_frame(6).valid(0));  // 1.6 m
}

TEST_CASE("an error is thrown by the tick of its image, not before") {
  std::string error;
  CHECK(ToyRun("{}", {.broken = 3}).run(&error) == Indices{0, 1, 2});
  CHECK_THAT(error, Contains("toy/folder/image.png") && Contains("frame 3") && Contains("cut short"));
  CHECK(ToyRun("{first: 1}", {.nan_pose = 1}).run(&error).empty());
  CHECK_THAT(error, Contains("toy/folder") && Contains("frame 1") && Contains("not finite"));
  CHECK(ToyRun("{}", {.sheared_pose = 2}).run(&error) == Indices{0, 1});
  CHECK_THAT(error, Contains("frame 2") && Contains("rigid"));
  CHECK(ToyRun("{}", {.repeated_stamp = 5}).run(&error) == Indices{0, 1, 2, 3, 4});
  CHECK_THAT(error, Contains("frame 5") && Contains("not later"));
}

TEST_CASE("a selection of nothing is an error before the first frame") {
  CHECK_THROWS_WITH(ToyRun("{first: 10}").h.tick(), Contains("toy/folder") && Contains("'first' is 10"));
  CHECK_THROWS_WITH(ToyRun("{}", {.images = 0}).h.tick(), Contains("holds no image"));
}

TEST_CASE("bad selection parameters are configuration errors") {
  CHECK_THROWS_WITH(ToyRun("{holdout: every tenth}"), Contains("every tenth"));
  CHECK_THROWS_AS(ToyRun("{stride: 0}"), ppm::ConfigError);
  CHECK_THROWS_AS(ToyRun("{pixel_stride: 0}"), ppm::ConfigError);
  CHECK_THROWS_AS(ToyRun("{last: -2}"), ppm::ConfigError);
  CHECK_THROWS_AS(ToyRun("{min_range: 2 kg}"), ppm::ConfigError);
}

TEST_CASE("the reference path is that of the selected images that have a pose") {
  ToyRun toy("{stride: 2, last: 8}", {.no_pose = 4});
  toy.source().open_for_evaluation();
  Indices indices;
  for (const auto& p : toy.source().reference()) {
    indices.push_back(p.frame);
    CHECK(p.T_map_camera.translation().x() == static_cast<double>(p.frame));
    CHECK(p.stamp_s == Approx(0.1 * static_cast<double>(p.frame)));
  }
  CHECK(indices == Indices{0, 2, 6, 8});
}

TEST_CASE("one image is read ahead, and a source may go while it is being read") {
  std::atomic<int> reads = 0;
  {
    ToyRun toy("{}", {.read_ms = 20, .reads = &reads});
    REQUIRE(toy.h.tick());
    for (int ms = 0; reads < 2 && ms < 5000; ++ms) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    CHECK(reads == 2);
    REQUIRE(toy.h.tick());
  }
  CHECK(reads == 3);
}

TEST_CASE("what was measured on the way to an image begins at the one that the graph got before") {
  ToyRun run("{first: 2, stride: 3}");
  std::vector<double> since;
  while (run.h.tick()) since.push_back(run.h.output<ppm::Frame>("frame")->imu.at(0).gyro.x());
  REQUIRE(since.size() == 3);
  CHECK(since[0] == Approx(0.1));  // of the image before in the sequence
  CHECK(since[1] == Approx(0.2));
  CHECK(since[2] == Approx(0.5));
  ToyRun whole("{}");
  whole.h.tick();
  CHECK(whole.h.output<ppm::Frame>("frame")->imu.at(0).gyro.x() == -std::numeric_limits<double>::infinity());
}
