#include "modules/sinks/color_params.hpp"

namespace ppm {

void ColorParams::declare(Params& params) {
  params.add_choice("show", show_, show_names())
      .doc("What colours say: shaded, a lit surface (pictures tint it by height); sigma, the standard deviation of the "
           "surface along its normal; mean, how far the surface lies from its faces; the direction of the normal; or "
           "the map's own color.");
  params.add("scale_low", low_)
      .unit("m")
      .range(-100, 100)
      .doc("Lower end of the colour scale of sigma and mean; where both ends are 0 the scale is the map's own.");
  params.add("scale_high", high_)
      .unit("m")
      .range(-100, 100)
      .doc("Upper end.")
      .check([this]() -> std::string {
        if (low_ == 0 && high_ == 0) return "";
        if (high_ <= low_) return "must be above scale_low";
        return show_ == Show::sigma && low_ <= 0 ? "the scale of sigma is logarithmic: scale_low must be positive" : "";
      });
}

Show ColorParams::show(const Mesh& mesh, Context& context) const {
  if (show_ != Show::color || !mesh.color.empty() || mesh.position.empty()) return show_;
  context.log().warning("{}: the map has no colour; it is shown without", context.node());
  return Show::shaded;
}

std::optional<ScaleRange> ColorParams::range() const {
  if (low_ == 0 && high_ == 0) return std::nullopt;
  return ScaleRange{low_, high_};
}

}  // namespace ppm
