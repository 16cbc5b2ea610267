#include "modules/maps/ppm/face_tiling.hpp"

#include <algorithm>

#include "modules/maps/ppm/texel_grid.hpp"

namespace ppm {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Line = std::vector<std::uint32_t>;

/// A triangular grid with n divisions. node(i, j): number of the node at u = i/n, v = j/n.
template <class NodeAt>
void tile_grid(std::uint32_t n, NodeAt node, Triangles& out) {
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; i + j < n; ++j) {
      out.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
      if (i + j + 2 <= n) out.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }
}

/// The strip between two lines that run the same way, `right` on the right of `left` seen along them. at_left, at_right:
/// how far along a node is; the next triangle goes to the nearer one.
template <class AtLeft, class AtRight>
void tile_strip(const Line& left, const Line& right, AtLeft at_left, AtRight at_right, Triangles& out) {
  std::size_t l = 0, r = 0;
  while (l + 1 < left.size() || r + 1 < right.size()) {
    const bool advance_right =
        r + 1 < right.size() &&
        (l + 1 == left.size() || at_right(r) + at_right(r + 1) <= at_left(l) + at_left(l + 1));
    if (advance_right) {
      out.push_back({left[l], right[r], right[r + 1]});
      ++r;
    } else {
      out.push_back({left[l], right[r], left[l + 1]});
      ++l;
    }
  }
}

/// The triangle between two lines that start in one apex; its third side is the segment between their ends.
void tile_wedge(const Line& left, const Line& right, Triangles& out) {
  out.push_back({left[0], right[1], left[1]});
  const Line l(left.begin() + 1, left.end()), r(right.begin() + 1, right.end());
  auto along = [](const Line& line) {
    return [steps = static_cast<double>(line.size())](std::size_t k) { return static_cast<double>(k + 1) / steps; };
  };
  tile_strip(l, r, along(l), along(r), out);
}

/// A face without nodes inside, of whose sides at least one is divided: two wedges, with the middle of the side that
/// is divided most as the end of both.
void tile_sides(const FaceNodes& nodes, Triangles& out) {
  std::size_t k = 0;
  for (std::size_t side = 1; side < 3; ++side)
    if (nodes.side[side].size() > nodes.side[k].size()) k = side;
  const Line &base = nodes.side[k], &next = nodes.side[(k + 1) % 3], &last = nodes.side[(k + 2) % 3];
  const auto middle = static_cast<std::ptrdiff_t>(base.size() / 2);
  tile_wedge(Line(last.rbegin(), last.rend()), Line(base.begin(), base.begin() + middle + 1), out);
  tile_wedge(Line(base.rbegin(), base.rend() - middle), next, out);
}

/// The nodes inside that are nearest to side k, in its direction.
Line inner_line(const FaceNodes& nodes, std::size_t k) {
  const std::uint32_t n = nodes.divisions - 3;
  Line line;
  for (std::uint32_t s = 0; s <= n; ++s) {
    const std::uint32_t i = k == 0 ? s : k == 1 ? n - s : 0, j = k == 0 ? 0 : k == 1 ? s : n - s;
    line.push_back(nodes.first_inside + texel_index(n, i, j));
  }
  return line;
}

}  // namespace

void tile_face(const FaceNodes& nodes, Triangles& out) {
  const std::uint32_t n = nodes.divisions;
  if (std::all_of(nodes.side.begin(), nodes.side.end(), [n](const Line& side) { return side.size() == n + 1; })) {
    tile_grid(
        n,
        [&](std::uint32_t i, std::uint32_t j) {
          if (j == 0) return nodes.side[0][i];
          if (i == 0) return nodes.side[2][n - j];
          if (i + j == n) return nodes.side[1][j];
          return nodes.first_inside + texel_index(n - 3, i - 1, j - 1);
        },
        out);
    return;
  }
  if (n < 3) return tile_sides(nodes, out);
  tile_grid(
      n - 3, [&](std::uint32_t i, std::uint32_t j) { return nodes.first_inside + texel_index(n - 3, i, j); }, out);
  for (std::size_t k = 0; k < 3; ++k) {
    const Line inner = inner_line(nodes, k);
    const auto steps = static_cast<double>(nodes.side[k].size() - 1);
    // In an equilateral face the inner node s lies beside (s + 1.5) / n of the side.
    tile_strip(
        inner, nodes.side[k], [n](std::size_t s) { return (static_cast<double>(s) + 1.5) / n; },
        [steps](std::size_t s) { return static_cast<double>(s) / steps; }, out);
  }
}

}  // namespace ppm
