#include <atomic>
#include <catch2/catch.hpp>

#include "framework/graph/harness.hpp"
#include "framework/roles/map_editor.hpp"
#include "tests/roles/toy_maps.hpp"

namespace {

using namespace ppm::test;

std::atomic<int> edits, in_place;

/// Adds 1 to the map, in place where its handle is the only one.
struct AddOne final : ppm::MapEditor {
  AddOne() : MapEditor({{"map.number"}, {}, {}}) {}
  ppm::MapHandle edit(ppm::Context&, std::size_t, ppm::MapHandle map, int) override {
    ++edits;
    if (map.use_count() > 1) return number_map(number_of(*map) + 1);
    ++in_place;
    ++const_cast<NumberMap&>(dynamic_cast<const NumberMap&>(*map)).number;
    return map;
  }
};

/// Adds 1, and looks at nothing but the map.
struct AddOneAnywhere final : ppm::MapEditor {
  AddOneAnywhere() : MapEditor({{"map.number"}, {}, {}}, ppm::EditReads::map) {}
  ppm::MapHandle edit(ppm::Context&, std::size_t, ppm::MapHandle map, int) override {
    ++edits;
    return number_map(number_of(*map) + 1);
  }
};

struct Forgets final : ppm::MapEditor {
  Forgets() : MapEditor({{"map.number"}, {}, {}}) {}
  ppm::MapHandle edit(ppm::Context&, std::size_t, ppm::MapHandle, int) override { return nullptr; }
};

const ppm::Registry& toys() {
  static const ppm::Registry registry = [] {
    ppm::Registry r;
    r.add<AddOne>("refinement.add_one", "Adds one.", "made up");
    r.add<AddOneAnywhere>("refinement.add_one_anywhere", "Adds one.", "made up");
    r.add<Forgets>("refinement.forgets", "Gives no map.", "made up");
    return r;
  }();
  return registry;
}

}  // namespace

TEST_CASE("copies of one ancestor are edited once and share the result") {
  for (int threads : {1, 4}) {
    ppm::Harness h(toys(), "refinement.add_one", "{}", threads);
    auto& belief = h.belief();
    belief.init(6, shifted(0), number_map(10));
    const auto view = std::make_shared<ppm::Prediction>();
    belief.prediction.assign(6, view);
    belief.map[2] = belief.map[5] = number_map(20);              // another map, two copies
    belief.pose[3] = shifted(1);                                 // the first map, elsewhere
    belief.prediction[4] = std::make_shared<ppm::Prediction>();  // the first map, another view
    edits = in_place = 0;
    h.tick();
    CHECK(edits == 4);
    std::vector<int> numbers;
    for (const auto& map : belief.map) numbers.push_back(number_of(*map));
    CHECK(numbers == std::vector<int>{11, 11, 21, 11, 11, 21});
    CHECK(belief.map[0] == belief.map[1]);
    CHECK(belief.map[2] == belief.map[5]);
    CHECK(belief.map[0] != belief.map[3]);
    CHECK(belief.map[0] != belief.map[4]);
    CHECK(belief.map[3] != belief.map[4]);
  }
}

TEST_CASE("an edit that reads maps alone is done once a map, whatever the poses and views") {
  ppm::Harness h(toys(), "refinement.add_one_anywhere");
  auto& belief = h.belief();
  belief.init(5, shifted(0), number_map(10));
  belief.pose[1] = shifted(1);
  belief.prediction[2] = std::make_shared<ppm::Prediction>();
  belief.map[3] = belief.map[4] = number_map(20);
  belief.pose[4] = shifted(2);
  edits = 0;
  h.tick();
  CHECK(edits == 2);
  CHECK(number_of(*belief.map[3]) == 21);
  for (std::size_t i : {1u, 2u}) CHECK(belief.map[i] == belief.map[0]);
  CHECK(belief.map[4] == belief.map[3]);
}

TEST_CASE("a map that only twins have is edited in place, a snapshot is never touched") {
  ppm::Harness h(toys(), "refinement.add_one");
  auto& belief = h.belief();
  belief.init(3, shifted(0), number_map(1));
  const auto* memory = belief.map[0].get();
  edits = in_place = 0;
  h.tick();
  CHECK(in_place == 1);
  CHECK(belief.map[0].get() == memory);
  CHECK(belief.map[2].get() == memory);

  const auto snapshot = belief.map[0];
  h.tick();
  CHECK(in_place == 1);
  CHECK(number_of(*snapshot) == 2);
  CHECK(number_of(*belief.map[0]) == 3);
}

TEST_CASE("an edit that gives no map is a bug that is told") {
  ppm::Harness h(toys(), "refinement.forgets");
  h.belief().init(1, shifted(0), number_map(1));
  CHECK_THROWS_AS(h.tick(), ppm::InternalError);
}
