#include <catch2/catch.hpp>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "framework/core/error.hpp"
#include "framework/core/parallel.hpp"

using ppm::Workers;

TEST_CASE("every item is done once, on a worker of the right number") {
  for (int threads : {1, 2, 4}) {
    Workers workers(threads);
    CHECK(workers.threads() == threads);
    for (std::size_t n : {0u, 1u, 3u, 100u, 10'000u}) {
      std::vector<std::atomic<int>> done(n);
      std::atomic<int> wrong = 0;
      workers.for_each(n, [&](std::size_t i, int worker) {
        ++done[i];
        if (worker < 0 || worker >= threads) ++wrong;
      });
      CHECK(wrong == 0);
      CHECK(std::all_of(done.begin(), done.end(), [](const auto& d) { return d == 1; }));
    }
  }
}

TEST_CASE("0 threads means as many as the machine has") {
  CHECK(Workers(0).threads() == static_cast<int>(std::thread::hardware_concurrency()));
}

TEST_CASE("N threads means N, also on a machine with fewer cores") {
  Workers workers(4);
  std::mutex mutex;
  std::set<std::thread::id> seen;
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (seen.size() < 4 && std::chrono::steady_clock::now() < until)
    workers.for_each(64, [&](std::size_t, int) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::scoped_lock lock(mutex);
      seen.insert(std::this_thread::get_id());
    });
  CHECK(seen.size() == 4);
}

TEST_CASE("no two items use one worker number at the same time, also with loops inside loops") {
  Workers workers(4);
  std::vector<std::atomic<int>> inside(4);
  std::atomic<int> wrong = 0;
  workers.for_each(64, [&](std::size_t, int worker) {
    auto& mine = inside[static_cast<std::size_t>(worker)];
    if (mine++ != 0) ++wrong;
    workers.for_each(16, [&](std::size_t, int) { std::this_thread::sleep_for(std::chrono::microseconds(20)); });
    --mine;
  });
  CHECK(wrong == 0);
}

TEST_CASE("an exception of a body reaches the caller, and the workers go on working") {
  Workers workers(2);
  auto fail = [&] {
    workers.for_each(100, [](std::size_t i, int) {
      if (i == 50) throw ppm::DataError("frame.png", 50, "cut short");
    });
  };
  CHECK_THROWS_AS(fail(), ppm::DataError);
  CHECK_THROWS_WITH(fail(), "frame.png (frame 50): cut short");
  std::atomic<int> n = 0;
  workers.for_each(100, [&](std::size_t, int) { ++n; });
  CHECK(n == 100);
}
