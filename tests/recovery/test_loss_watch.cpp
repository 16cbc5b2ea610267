#include <catch2/catch.hpp>
#include <vector>

#include "modules/recovery/loss_watch.hpp"

using namespace ppm;
using Phase = LossWatch::Phase;

namespace {

constexpr ViewFit kGood{0.03f, 0.2f}, kDoubtful{0.25f, 0.2f}, kWrong{0.6f, 0.1f}, kNothing{0.0f, 0.95f};

/// The phases after frames of one particle each.
std::vector<Phase> phases(LossWatch& watch, const std::vector<ViewFit>& frames) {
  std::vector<Phase> out;
  for (const auto& fit : frames) out.push_back(watch.next({&fit, 1}));
  return out;
}

}  // namespace

TEST_CASE("the camera is lost when so many frames in a row are not explained") {
  LossWatch watch;
  using enum Phase;
  CHECK(phases(watch, {kGood, kWrong, kWrong, kGood, kWrong, kNothing, kDoubtful, kWrong}) ==
        std::vector{tracked, tracked, tracked, tracked, tracked, tracked, tracked, lost});
}

TEST_CASE("one particle that explains a frame is enough") {
  LossWatch watch;
  for (int frame = 0; frame < 10; ++frame) {
    CHECK(watch.next(std::vector<ViewFit>{kWrong, kGood, kNothing}) == Phase::tracked);
    CHECK(watch.sure());
  }
}

TEST_CASE("a place that explains a frame must hold for a few more") {
  LossWatch watch;
  using enum Phase;
  watch.lose();
  CHECK(phases(watch, {kDoubtful, kGood, kGood, kGood, kWrong}) == std::vector{lost, returning, returning, returning, lost});
  watch.returned();
  CHECK(phases(watch, {kGood, kDoubtful, kGood, kGood}) == std::vector{returning, returning, returning, tracked});
  CHECK(watch.sure());
}

TEST_CASE("a frame that nothing explains is not sure, before any loss is declared") {
  LossWatch watch;
  phases(watch, {kGood, kWrong});
  CHECK(watch.phase() == Phase::tracked);
  CHECK(watch.verdict() == LossWatch::Verdict::unexplained);
  CHECK_FALSE(watch.sure());
}

TEST_CASE("frames that are explained, but not well, raise a doubt now and then, and no loss") {
  LossWatch watch;
  std::vector<int> doubted;
  for (int frame = 1; frame <= 12; ++frame) {
    watch.next({&kDoubtful, 1});
    if (watch.doubted()) doubted.push_back(frame);
  }
  CHECK(doubted == std::vector{5, 10});
  CHECK(watch.phase() == Phase::tracked);
  watch.next({&kGood, 1});
  CHECK(watch.doubt() == 0);
  CHECK_FALSE(watch.doubted());
}
