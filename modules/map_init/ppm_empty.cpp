#include "framework/graph/registry.hpp"
#include "framework/roles/empty_map.hpp"
#include "modules/maps/ppm/ppm_codec.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {
namespace {

enum class TextureColor { none = 0, intensity = 1, rgb = 3 };  // channels

/// Starts with an empty mesh.
/// throws  DataError where the map has colour and the first frame none
class PpmEmpty final : public EmptyMap {
 public:
  PpmEmpty() : EmptyMap("map.ppm") {
    params_.add("cell_size", settings_.cell_size_m)
        .unit("m")
        .above(0)
        .doc(
            "Edge of the cubic cells that the map is cut into. Particles share what they did not change cell by "
            "cell.");
    params_.add("texel_size", settings_.texel_size_m)
        .unit("m")
        .above(0)
        .doc("Distance between texels on a face, at most: the level of detail below that of the faces.");
    params_.add("prior_sigma", settings_.prior_sigma_m)
        .unit("m")
        .above(0)
        .doc("Standard deviation of the offset between a face and the true surface before it is observed.");
    params_
        .add_choice(
            "color", color_,
            {{"none", TextureColor::none}, {"intensity", TextureColor::intensity}, {"rgb", TextureColor::rgb}})
        .doc(
            "Colour in the texture, mean and variance a texel: none, its intensity, or red, green and blue. The source "
            "must give colour images then.");
  }

 protected:
  MapHandle make(const Frame& first) const override {
    auto settings = settings_;
    settings.color_channels = static_cast<int>(color_);
    if (settings.color_channels > 0 && first.color.empty())
      throw DataError("the source", first.index, "gives no colour for the map; set `color: true` at the source");
    return std::make_shared<const PpmMap>(settings);
  }

 private:
  TextureColor color_ = TextureColor::none;
  PpmSettings settings_;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add_map_kind<ppm::PpmCodec>("ppm");
  r.add<ppm::PpmEmpty>("map.ppm_empty",
                       "Starts the belief: particles at one pose that share one empty probabilistic mesh.",
                       "paper, sections 3 and 4");
}
