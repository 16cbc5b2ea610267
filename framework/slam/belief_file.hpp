#pragma once
#include "framework/core/record_file.hpp"
#include "framework/slam/map_codec.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// Writes a belief as records: poses, weights, paths, typed columns and maps, what particles share once each. Predictions
/// only where asked for: each frame makes its own as a rule.
/// Throws ConfigError where there is no codec for a kind of map.
void save_belief(const ParticleSet& belief, const MapCodecs& codecs, bool predictions, RecordFileWriter& file);
/// Reads it back, sharing as before. Throws DataError.
void load_belief(ParticleSet& belief, const MapCodecs& codecs, RecordFileReader& file);

}  // namespace ppm
