#pragma once
#include <memory>

#include "framework/core/se3.hpp"
#include "framework/slam/map.hpp"

namespace ppm::test {

/// A map that is a number.
class NumberMap final : public Map {
 public:
  explicit NumberMap(int n) : number(n) {}
  std::string_view kind() const override { return "number"; }
  MapStats stats() const override { return {}; }
  std::int64_t account(std::unordered_set<const void*>&) const override { return 0; }
  void digest(Digest&) const override {}
  Mesh mesh(Surface) const override { return {}; }
  int number;
};

inline MapHandle number_map(int n) {
  return std::make_shared<NumberMap>(n);
}
inline int number_of(const Map& map) {
  return dynamic_cast<const NumberMap&>(map).number;
}

inline Pose shifted(double x) {
  Pose T = Pose::Identity();
  T.translation().x() = x;
  return T;
}

}  // namespace ppm::test
