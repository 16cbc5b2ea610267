#include <catch2/catch.hpp>
#include <numeric>
#include <thread>
#include <vector>

#include "framework/core/cow.hpp"
#include "framework/core/rng.hpp"

using ppm::Cow;

namespace {

/// Counts the objects alive and the copies made.
struct Counted {
  static inline std::atomic<int> alive = 0, copies = 0;
  explicit Counted(int v) : value(v) { ++alive; }
  Counted(const Counted& o) : value(o.value) {
    ++alive;
    ++copies;
  }
  Counted(Counted&& o) noexcept : value(o.value) { ++alive; }
  ~Counted() { --alive; }
  int value;
};

}  // namespace

TEST_CASE("copies share until one is written to") {
  Counted::copies = 0;
  {
    auto a = Cow<Counted>::make(1);
    CHECK(a.unique());
    auto b = a;
    CHECK(a == b);
    CHECK(a.use_count() == 2);
    CHECK(Counted::alive == 1);

    b.write().value = 2;
    CHECK(a->value == 1);
    CHECK(b->value == 2);
    CHECK_FALSE(a == b);
    CHECK(Counted::alive == 2);
    CHECK(Counted::copies == 1);

    const auto* before = b.get();
    b.write().value = 3;  // alone: in place
    CHECK(b.get() == before);
    CHECK(Counted::copies == 1);
  }
  CHECK(Counted::alive == 0);
}

TEST_CASE("a handle that is the only one left writes in place again") {
  Counted::copies = 0;
  auto a = Cow<Counted>::make(1);
  { auto b = a; }
  a.write().value = 5;
  CHECK(Counted::copies == 0);
}

TEST_CASE("empty handles, moves and self-assignment") {
  Cow<int> empty;
  CHECK_FALSE(empty);
  CHECK(empty.get() == nullptr);
  CHECK(empty.use_count() == 0);
  CHECK_FALSE(empty.unique());

  auto a = Cow<int>::make(7);
  auto b = std::move(a);
  CHECK_FALSE(a);
  CHECK(b.unique());
  auto& same = b;
  b = same;
  CHECK(*b == 7);
  CHECK(b.unique());
  b = Cow<int>();
  CHECK_FALSE(b);
}

TEST_CASE("random copies, writes and drops agree with plain values") {
  ppm::Rng rng(11, 0, 0, 0);
  std::vector<Cow<int>> handles(20);
  std::vector<int> plain(20, 0);
  for (auto& h : handles) h = Cow<int>::make(0);
  for (int step = 0; step < 5000; ++step) {
    const auto i = rng.below(20), j = rng.below(20);
    if (rng.below(2) == 0) {
      handles[i] = handles[j];
      plain[i] = plain[j];
    } else {
      handles[i].write() = step;
      plain[i] = step;
    }
  }
  for (std::size_t i = 0; i < handles.size(); ++i) CHECK(*handles[i] == plain[i]);
}

TEST_CASE("threads that copy, read, write and drop handles to one value") {
  Counted::copies = 0;
  {
    const auto shared = Cow<Counted>::make(42);
    std::atomic<int> wrong = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < 2000; ++i) {
          auto mine = shared;
          if (mine->value != 42) ++wrong;
          mine.write().value = t;
          if (mine->value != t || !mine.unique()) ++wrong;
        }
      });
    for (auto& t : threads) t.join();
    CHECK(wrong == 0);
    CHECK(shared->value == 42);
    CHECK(shared.unique());
    CHECK(Counted::alive == 1);
  }
  CHECK(Counted::alive == 0);
}
