#include <string>
#include <vector>

#include "framework/core/atomic_file.hpp"
#include "framework/graph/registry.hpp"
#include "framework/roles/online_path.hpp"
#include "framework/slam/particle_set.hpp"
#include "framework/slam/tum_trajectory.hpp"

namespace ppm {
namespace {

/// Writes two paths at the end of the run: what the filter believes of all frames in hindsight, and what it believed of
/// each frame when it was there.
class TrajectoryTum final : public Module, public OnlinePath {
 public:
  In<Belief> belief{this, {{"belief"}, {}, {}}};

  TrajectoryTum() {
    params_.add("file", file_).doc("Name of the file for the whole path of the particle that is best at the end.");
    params_.add("online_file", online_file_)
        .doc("Name of the file for the filter's pose of each frame, as it was then.");
    params_.add_choice("online", estimate_, estimate_names())
        .doc(
            "Which pose that is: of the best particle; the weighted mean of all; or the mode, where they are densest.");
  }

  void tick(Context&) override {
    path_ = belief->trajectory[belief->best()];
    online_.push_back(path_.last());
    online_.back().T_map_camera = estimate_pose(*belief, estimate_);
  }

  void save(RecordWriter& out) const override {
    save_paths(out, {path_});
    out.add(online_);
  }
  void load(RecordReader& in) override {
    path_ = load_paths(in).at(0);
    in.take(online_);
  }

  void close(Context& context) override {
    write_file(context.output(file_), to_tum(path_.poses()));
    write_file(context.output(online_file_), to_tum(online_));
  }

  const std::vector<StampedPose>& online_path() const override { return online_; }
  Estimate online_estimate() const override { return estimate_; }

 private:
  std::string file_ = "trajectory.tum", online_file_ = "trajectory_online.tum";
  Estimate estimate_ = Estimate::best;
  Trajectory path_;
  std::vector<StampedPose> online_;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::TrajectoryTum>("sink.trajectory_tum",
                            "Writes the estimated path in TUM format, in hindsight and as it was at each frame.",
                            "Sturm et al., \"A benchmark for the evaluation of RGB-D SLAM systems\", IROS 2012");
}
