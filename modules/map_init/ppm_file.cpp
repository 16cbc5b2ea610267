#include <string>

#include "framework/core/data_path.hpp"
#include "framework/graph/registry.hpp"
#include "framework/roles/pose_noise.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/particle_set.hpp"
#include "framework/slam/tum_trajectory.hpp"
#include "modules/maps/ppm/ppm_file.hpp"

namespace ppm {
namespace {

enum class Start { reference, identity, pose, unknown };

/// Makes the belief from a saved map: particles with equal weights around one pose, sharing the map; the first frame is
/// on every path. For localisation in a map that is there, and for mapping on. Runs in the first frame
/// (`when: {until_frame: 0}`); it starts over wherever it runs. Where the start is unknown the particles stand at the map's
/// origin and the belief is lost: a recovery.* node finds the place, and until then no map learns.
/// throws  DataError where the file is no sound map, or the start is the reference and the frame has none
class PpmFile final : public Module {
 public:
  In<Frame> frame{this, "frame", "The first frame: its stamp, and its reference pose."};
  InOut<Belief> belief{this, {{}, {"belief", "map.ppm"}, {"prediction"}}};

  PpmFile() {
    params_.add("path", path_)
        .required()
        .doc(
            "The map: a file that sink.map_ppm wrote, or the folder of a run that holds one as map.ppm. Relative to the "
            "current directory; ${PPM_DATA} may stand first.");
    params_.add("particles", particles_).range(1, 1'000'000).doc("Number of particles.");
    params_.add_choice("start", start_,
                       {{"reference", Start::reference},
                        {"identity", Start::identity},
                        {"pose", Start::pose},
                        {"unknown", Start::unknown}})
        .doc(
            "The camera's first pose in the map frame: the frame's reference pose (for a map in the reference's frame), "
            "identity, the one that `pose` gives, or unknown (a recovery.* node must find it).");
    params_.add("pose", pose_)
        .check([this] {
          Pose T_map_camera;
          return pose_.empty() ? std::string() : parse_tum_pose(pose_, T_map_camera);
        })
        .doc(
            "The start where `start: pose`, as a line of a TUM file has it behind the stamp: \"tx ty tz qx qy qz qw\", "
            "metres.");
    spread_.declare(params_, "spread of the particles' first poses");
  }

  void open(Context&) override {
    if (start_ == Start::pose && pose_.empty()) throw ConfigError({}, "`start: pose` needs the parameter 'pose'");
    if (start_ != Start::pose && !pose_.empty()) throw ConfigError({}, "'pose' is given, but the start is not `start: pose`");
    const auto path = expand_data_path(path_);
    map_ = load_ppm(std::filesystem::is_directory(path) ? path / "map.ppm" : path);
  }

  void tick(Context& context) override {
    const auto first = frame.get();
    const auto& reference = first->T_world_camera_ref;
    const Pose T_map_camera = start_pose(*first);
    auto& particles = *belief;
    particles.init(static_cast<std::size_t>(particles_), T_map_camera, map_);
    if (start_ != Start::reference) {
      particles.T_map_world.reset();
      if (reference && start_ != Start::unknown) particles.T_map_world = T_map_camera * reference->inverse();
    }
    particles.lost = start_ == Start::unknown;
    for (std::size_t i = 0; i < particles.size(); ++i)
      particles.extend(i, {first->index, first->stamp_s, T_map_camera * spread_.draw(context.rng("spread", i))});
  }

 private:
  Pose start_pose(const Frame& first) const {
    Pose T_map_camera = Pose::Identity();
    if (start_ == Start::pose) parse_tum_pose(pose_, T_map_camera);
    if (start_ != Start::reference) return T_map_camera;
    if (!first.T_world_camera_ref)
      throw DataError("the source", first.index, "has no reference pose to start at; set `start: pose` or `start: identity`");
    return *first.T_world_camera_ref;
  }

  std::filesystem::path path_;
  int particles_ = 100;
  Start start_ = Start::reference;
  std::string pose_;
  PoseNoise spread_;
  std::shared_ptr<const PpmMap> map_;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::PpmFile>("map.ppm_file", "Starts the belief from a saved mesh map: for localisation in it, or to map on.",
                      "Thrun, Burgard, Fox, \"Probabilistic Robotics\", 2005, chapter 8 (Monte Carlo localization)");
}
