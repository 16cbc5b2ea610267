#include "modules/prediction/embree_view.hpp"

#include <algorithm>
#include <numeric>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/prediction/embree_packet_inl.hpp"

namespace ppm {
namespace {

constexpr int kTile = 16;  // px: chunks are sorted out for a tile first, then for each packet in it

/// The chunks that may show in a tile, nearest first.
void sort_out(const std::vector<VisibleChunk>& visible, int x, int y, std::vector<VisibleChunk>& in_tile) {
  in_tile.clear();
  for (const auto& v : visible)
    if (v.meets(x, y, x + kTile - 1, y + kTile - 1)) in_tile.push_back(v);
}

template <int N>
void keep(const RayPacket<N>& packet, int lane, std::size_t at, ElementHits& hits) {
  hits.range[at] = packet.range(lane);
  hits.u[at] = packet.u[lane];
  hits.v[at] = packet.v[lane];
  hits.facing[at] = packet.facing[lane];
  hits.chunk[at] = packet.chunk[lane];
  hits.face[at] = packet.face[lane];
}

template <int N>
void trace_tile(RayPacket<N>& packet, int x0, int y0, const Rows& rows, int cols,
                const std::vector<VisibleChunk>& chunks, ElementHits& hits) {
  using P = Packet<N>;
  for (int y = y0; y < std::min(y0 + kTile, rows.end); y += P::rows)
    for (int x = x0; x < std::min(x0 + kTile, cols); x += P::cols) {
      for (int i = 0; i < N; ++i) {
        packet.x[i] = x + i % P::cols;
        packet.y[i] = y + i / P::cols;
        packet.on[i] = packet.x[i] < cols && packet.y[i] < rows.end;
      }
      packet.trace(chunks);
      for (int i = 0; i < N; ++i)
        if (packet.chunk[i] != Prediction::kNone)
          keep(packet, i, static_cast<std::size_t>(packet.y[i] * cols + packet.x[i]), hits);
    }
}

template <int N>
void trace_rows(const std::vector<const EmbreeScene*>& scenes, const std::vector<VisibleChunk>& visible,
                const EmbreeViewOptions& options, const Rows& rows, const Prediction& view, ElementHits& hits) {
  RayPacket<N> packet(scenes, options, view);
  std::vector<VisibleChunk> in_tile;
  for (int y = rows.first; y < rows.end; y += kTile)
    for (int x = 0; x < view.camera.cols; x += kTile) {
      sort_out(visible, x, y, in_tile);
      if (!in_tile.empty()) trace_tile(packet, x, y, rows, view.camera.cols, in_tile, hits);
    }
}

/// Some pixels of a view, so that those of a tile follow each other, each with its place in the list.
struct TilePixel {
  int x, y;
  std::size_t at;
};
std::vector<TilePixel> by_tiles(std::span<const std::uint32_t> pixels, const Camera& camera) {
  const int tiles_x = (camera.cols + kTile - 1) / kTile, tiles = tiles_x * ((camera.rows + kTile - 1) / kTile);
  const auto cols = static_cast<std::uint32_t>(camera.cols);
  auto tile_of = [&](std::uint32_t p) {
    return static_cast<std::size_t>(static_cast<int>(p / cols) / kTile * tiles_x + static_cast<int>(p % cols) / kTile);
  };
  std::vector<std::size_t> first(static_cast<std::size_t>(tiles) + 1);
  for (auto p : pixels) ++first[tile_of(p) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<TilePixel> sorted(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    sorted[first[tile_of(pixels[i])]++] = {static_cast<int>(pixels[i] % cols), static_cast<int>(pixels[i] / cols), i};
  return sorted;
}

template <int N>
void trace_pixels(const std::vector<const EmbreeScene*>& scenes, const std::vector<VisibleChunk>& visible,
                  const EmbreeViewOptions& options, std::span<const std::uint32_t> pixels, const Prediction& view,
                  ElementHits& hits) {
  RayPacket<N> packet(scenes, options, view);
  const auto sorted = by_tiles(pixels, view.camera);
  for (std::size_t first = 0; first < sorted.size(); first += N) {
    const auto count = std::min<std::size_t>(N, sorted.size() - first);
    for (std::size_t i = 0; i < N; ++i) {
      const TilePixel& pixel = sorted[first + std::min(i, count - 1)];
      packet.x[i] = pixel.x;
      packet.y[i] = pixel.y;
      packet.on[i] = i < count;
    }
    packet.trace(visible);
    for (std::size_t i = 0; i < count; ++i)
      if (packet.chunk[i] != Prediction::kNone) keep(packet, static_cast<int>(i), sorted[first + i].at, hits);
  }
}

/// Calls with_size(std::integral_constant<int, N>) for packets of N rays.
template <class WithSize>
void for_packet(int rays, const WithSize& with_size) {
  switch (rays) {
    case 1:
      return with_size(std::integral_constant<int, 1>());
    case 4:
      return with_size(std::integral_constant<int, 4>());
    case 8:
      return with_size(std::integral_constant<int, 8>());
    case 16:
      return with_size(std::integral_constant<int, 16>());
    default:
      PPM_CHECK(false, "packets of {} rays", rays);
  }
}

}  // namespace

void trace_hits(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
                const Rows& rows, const Prediction& view, ElementHits& hits) {
  const auto visible = visible_chunks(map, view.camera, view.T_map_camera);
  for_packet(options.packet, [&](auto n) { trace_rows<n()>(scenes, visible, options, rows, view, hits); });
}

void trace_view(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
                const Rows& rows, Prediction& out) {
  ElementView view;
  view.start(map, options.linear_texels, static_cast<std::size_t>(out.camera.pixels()));
  trace_hits(map, scenes, options, rows, out, view.hits());
  view.fill(out, rows, out);
}

void EmbreeRays::start(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes,
                       const EmbreeViewOptions& options, const Prediction& view) {
  map_ = &map;
  scenes_ = &scenes;
  options_ = options;
  visible_ = visible_chunks(map, view.camera, view.T_map_camera);
}

void EmbreeRays::sample(const Prediction& view, std::span<const std::uint32_t> pixels, ViewSamples& out) const {
  ElementHits hits;
  hits.reset(pixels.size());
  for_packet(options_.packet,
             [&](auto n) { trace_pixels<n()>(*scenes_, visible_, options_, pixels, view, hits); });
  for (std::size_t i = 0; i < pixels.size(); ++i) sample_hit(*map_, options_.linear_texels, hits, i, i, out);
}

void EmbreeRays::fill(const Prediction&, const Rows& rows, Prediction& out) const {
  trace_view(*map_, *scenes_, options_, rows, out);
}

}  // namespace ppm
