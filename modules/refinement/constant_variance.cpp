#include <algorithm>

#include "framework/graph/registry.hpp"
#include "framework/roles/map_editor.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"

namespace {

using namespace ppm;

/// Forgets how certain each texel is: all variances become one constant, those of faces nothing. Behind a map_update.* in
/// every frame it makes the texels' Bayesian update one of a fixed gain, and the map one that knows a surface but no
/// uncertainty. For measuring what the variance is worth.
/// source  paper, section 3 (which asks for the contrary)
class ConstantVariance final : public MapEditor {
 public:
  ConstantVariance() : MapEditor({{"map.ppm"}, {}, {}}, EditReads::map) {
    params_.add("sigma", sigma_m_).unit("m").above(0).doc("Standard deviation of every texel.");
  }

  MapHandle edit(Context&, std::size_t, MapHandle map, int) override {
    const auto variance = static_cast<float>(sigma_m_ * sigma_m_);
    PpmEdit edit(std::static_pointer_cast<const PpmMap>(std::move(map)));
    for (std::uint32_t c = 0; c < edit.map().table().size(); ++c)
      if (!is_constant(*edit.map().table()[c].texels, variance)) make_constant(edit.texels(c), variance);
    return edit.commit();
  }

 private:
  static bool is_constant(const Texels& texels, float variance) {
    return std::ranges::all_of(texels.variance, [=](float v) { return v == variance; }) &&
           std::ranges::all_of(texels.evidence, [](const FaceEvidence& e) { return e.excess == 0; });
  }
  static void make_constant(Texels& texels, float variance) {
    std::ranges::fill(texels.variance, variance);
    for (auto& e : texels.evidence) e.excess = 0;
  }

  double sigma_m_ = 0.005;
};

}  // namespace

PPM_MODULES(r) {
  r.add<ConstantVariance>("refinement.constant_variance",
                          "Makes all texels equally certain: to measure what their variance is worth.",
                          "paper, section 3 (the contrary of its variances)");
}
