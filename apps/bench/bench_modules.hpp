#pragma once
#include "apps/bench/bench_world.hpp"
#include "framework/graph/registry.hpp"

namespace ppm {

/// Adds the modules that benchmark graphs have beside those that are timed:
///   source.bench   the world's images, over and over
///   map.bench      `particles` of them at the first image's pose, with one map or, with `own`, with maps that share
///   nothing sink.bench     keeps the maps of the frame before, so that every chunk that an update writes is cloned
///   weighting.bench_fill   fills all arrays of every view
/// world: must outlive the registry.
void add_bench_modules(Registry& registry, BenchWorld& world);

}  // namespace ppm
