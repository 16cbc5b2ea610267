#include "modules/maps/ppm/dense_mesh.hpp"

namespace ppm {

Mesh PpmMap::mesh(Surface surface) const {
  return surface == Surface::base ? base_mesh(*this) : dense_mesh(*this);
}

}  // namespace ppm
