#pragma once
#include <cstdint>
#include <span>

#include "modules/prediction/element_view.hpp"
#include "modules/prediction/face_numbers.hpp"

namespace ppm {

/// Finds where rays meet the faces that a rasterizer says they see. number: the face of each pixel of the view, by
/// `faces`, which counts those of `map`; rows: which to do. A rasterizer takes corners to a grid a little finer than
/// pixels, so a ray may pass just beside its face: it is given the point of the face near by. view: its camera and pose
/// are read; hits: sized for it, misses in these rows.
void hits_of_faces(const PpmMap& map, const FaceNumbers& faces, std::span<const std::uint32_t> number, const Rows& rows,
                   const Prediction& view, ElementHits& hits);

}  // namespace ppm
