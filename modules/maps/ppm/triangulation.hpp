#pragma once
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "modules/maps/ppm/delaunay.hpp"

namespace ppm {

/// A Delaunay triangulation into which edges can be forced, by flipping those that cross them.
/// Source: Sloan, "A fast algorithm for generating constrained Delaunay triangulations", Computers & Structures 1993.
class Triangulation {
 public:
  explicit Triangulation(std::vector<GridPoint> points);

  /// Makes (a, b) an edge and keeps it. False, and nothing is kept, where a point lies on it, an edge kept before
  /// crosses it, or an end was left out as a double.
  bool keep_edge(std::uint32_t a, std::uint32_t b);
  /// All triangles, positive area each.
  const std::vector<PlaneTriangle>& triangles() const { return triangle_; }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  struct Side {
    std::uint32_t triangle = kNone;
    std::uint32_t corner = 0;  // the edge runs from this corner of the triangle to the next
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;

  Side side(std::uint32_t a, std::uint32_t b) const;  // the triangle with the directed edge (a, b)
  bool crossed(std::uint32_t a, std::uint32_t b, std::vector<Edge>& edges) const;
  bool crosses(const Edge& e, std::uint32_t a, std::uint32_t b) const;
  bool flip(const Edge& e, Edge& flipped);
  void mend(std::vector<Edge> made, std::uint32_t a, std::uint32_t b);
  bool is_delaunay(const Edge& e) const;
  bool is_kept(const Edge& e) const;
  std::uint32_t next(std::uint32_t t, std::uint32_t corner) const { return triangle_[t][(corner + 1) % 3]; }
  std::uint32_t apex(const Side& s) const { return triangle_[s.triangle][(s.corner + 2) % 3]; }
  void relink(std::uint32_t t);

  std::vector<GridPoint> point_;
  std::vector<PlaneTriangle> triangle_;
  std::vector<std::vector<std::uint32_t>> around_;  // by point: its triangles
  std::vector<Edge> kept_;                          // lower point first
};

}  // namespace ppm
