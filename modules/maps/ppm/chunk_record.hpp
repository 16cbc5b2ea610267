#pragma once
#include "framework/core/record.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

// The parts of a mesh map as they stand in files: in map.ppm and in checkpoints. Derived parts of a chunk (first texels, open edges,
// box) are computed again; the geometry gets a new id. Where the bytes are no sound part, in.fail() throws DataError.

void save(RecordWriter& out, const Geometry& geometry);
void load(RecordReader& in, Geometry& geometry);
void save(RecordWriter& out, const Texels& texels);
void load(RecordReader& in, Texels& texels);
void save(RecordWriter& out, const PpmSettings& settings);
void load(RecordReader& in, PpmSettings& settings);

}  // namespace ppm
