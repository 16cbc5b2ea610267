#pragma once
#include <optional>

#include "framework/config/params.hpp"
#include "framework/graph/context.hpp"
#include "modules/maps/picture/color_scale.hpp"

namespace ppm {

/// The parameters `show`, `scale_low` and `scale_high` of sinks that show a map in colours.
class ColorParams {
 public:
  explicit ColorParams(Show show) : show_(show) {}
  void declare(Params& params);
  /// What to show of this mesh; where its colour is wanted and it has none, shaded, with a warning.
  Show show(const Mesh& mesh, Context& context) const;
  /// None: the mesh's own.
  std::optional<ScaleRange> range() const;

 private:
  Show show_;
  float low_ = 0, high_ = 0;
};

}  // namespace ppm
