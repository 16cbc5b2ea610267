#include "framework/graph/registry.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/maps/ppm/ppm_codec.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {
namespace {

enum class Start { reference, identity };
enum class TextureColor { none = 0, intensity = 1, rgb = 3 };  // channels

/// Makes the belief: particles with equal weights at one pose, sharing one empty mesh map; the first frame is on every
/// path. Runs in the first frame (`when: {until_frame: 0}`); it starts over wherever it runs.
/// throws  DataError where the start is the reference and the frame has none, or the map has colour and the frame none
class PpmEmpty final : public Module {
 public:
  In<Frame> frame{this, "frame", "The first frame: its stamp, and its reference pose where the map starts there."};
  InOut<Belief> belief{this, {{}, {"belief", "map.ppm"}, {"prediction"}}};

  PpmEmpty() {
    params_.add("particles", particles_).range(1, 1'000'000).doc("Number of particles.");
    params_.add_choice("start", start_, {{"reference", Start::reference}, {"identity", Start::identity}})
        .doc(
            "The camera's first pose in the map frame: the frame's reference pose, so that map and reference share one "
            "frame, or identity.");
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

  void tick(Context&) override {
    const auto first = frame.get();
    const auto& reference = first->T_world_camera_ref;
    if (start_ == Start::reference && !reference)
      throw DataError("the source", first->index, "has no reference pose to start the map at; set `start: identity`");
    const Pose T_map_camera = start_ == Start::reference ? *reference : Pose::Identity();
    settings_.color_channels = static_cast<int>(color_);
    if (settings_.color_channels > 0 && first->color.empty())
      throw DataError("the source", first->index, "gives no colour for the map; set `color: true` at the source");
    auto& particles = *belief;
    particles.init(static_cast<std::size_t>(particles_), T_map_camera, std::make_shared<const PpmMap>(settings_));
    if (start_ == Start::identity) {
      particles.T_map_world.reset();
      if (reference) particles.T_map_world = reference->inverse();
    }
    for (std::size_t i = 0; i < particles.size(); ++i)
      particles.extend(i, {first->index, first->stamp_s, T_map_camera});
  }

 private:
  int particles_ = 100;
  Start start_ = Start::reference;
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
