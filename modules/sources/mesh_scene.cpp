#include <algorithm>
#include <cmath>

#include "framework/graph/registry.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/slam/tum_trajectory.hpp"
#include "modules/sources/data_path.hpp"
#include "modules/sources/house_plans.hpp"
#include "modules/sources/mesh_sequence.hpp"
#include "modules/sources/simulated_imu.hpp"
#include "modules/sources/simulated_odometry.hpp"
#include "modules/sources/waypoint_file.hpp"

namespace ppm {
namespace {

/// The cameras that have a name.
enum class Model { tof176, sr4000, kinect320 };
enum class NoiseChoice { camera, exact, kinect, tof };

Camera camera_with(int cols, int rows, double focal_px) {
  return {cols, rows, focal_px, focal_px, (cols - 1) / 2.0, (rows - 1) / 2.0};
}

Camera camera_of(Model model) {
  if (model == Model::kinect320) return camera_with(320, 240, 292.5);
  return camera_with(176, 144, model == Model::sr4000 ? 220 : 128);
}

/// A range camera that is moved through a mesh from a file, by default a furnished house. World frame: the mesh's own, z up.
/// The moving body (base) is the camera: x right, y down, z forward.
/// frame   depth with the chosen noise; sigma is the true one for time of flight, else from the noise parameters; exact
///         reference poses; if asked for, imu (SimulatedImu) and T_odom_base (SimulatedOdometry)
/// throws  DataError naming file and line or byte: mesh, trajectory or waypoints missing or malformed
/// source  noise models: see MeshCamera
class MeshScene final : public FrameSource {
 public:
  MeshScene() {
    params_.add("file", file_).doc(
        "The mesh, a PLY file in metres with z up. A leading ${PPM_DATA} is replaced by that environment variable, or by "
        "../shared/data.");
    declare_path();
    declare_camera();
    declare_imu();
    declare_odometry();
  }

 private:
  void declare_path() {
    params_.add_choice("plan", plan_, {{"loop", HousePlan::loop},
                                            {"tour", HousePlan::tour},
                                            {"corridor", HousePlan::corridor},
                                            {"fast_turn", HousePlan::fast_turn},
                                            {"kidnap", HousePlan::kidnap}})
        .doc(
            "The way through house.ply; not used where waypoints or a trajectory are given. loop: 31 m through two rooms; "
            "tour: 55 m through all; corridor: along a bare wall; fast_turn: too fast for the images to overlap; kidnap: with "
            "a jump to where the camera was before.");
    params_.add("waypoints", waypoints_)
        .check([this] { return contradiction(); })
        .doc("A file of waypoints for any mesh: lines 'x y z yaw pitch [seconds]', m and degrees, or 'jump'.");
    params_.add("trajectory", trajectory_)
        .check([this] { return contradiction(); })
        .doc("A TUM file of camera poses, each of which makes a frame; rate, speed, turning and sway do not count then.");
    params_.add("frames", frames_).range(-1, 1e6).doc("Length of the sequence at most; -1: the whole way.");
    params_.add("rate", rate_).unit("Hz").above(0).doc("Frames per second.");
    params_.add("speed", gait_.speed).unit("m/s").above(0).doc("How fast the camera is carried between waypoints.");
    params_.add("turning", gait_.turning).unit("rad/s").above(0).doc("How fast it turns at most between waypoints.");
    params_.add("sway", gait_.sway)
        .range(0, 10)
        .doc("Scale of the movement of the hand, a sum of swings of 1 cm and 1 degree, 0.2 to 1 a second; 0: none.");
  }
  void declare_camera() {
    params_
        .add_choice("camera", model_,
                    {{"tof176", Model::tof176}, {"sr4000", Model::sr4000}, {"kinect320", Model::kinect320}})
        .doc(
            "The simulated camera. tof176: time of flight, 176x144 pixels, 69 x 59 degrees (SR4000 with its wide lens); sr4000: the same with "
            "its standard lens, 44 x 36 degrees; kinect320: structured light, 320x240 pixels, 57 x 45 degrees.");
    params_.add("cols", cols_).range(0, 4096).doc("Width of the image in pixels; 0: the camera's.");
    params_.add("rows", rows_).range(0, 4096).doc("Height of the image in pixels; 0: the camera's.");
    params_.add("fov", fov_).unit("rad").range(0, 3).doc("Horizontal field of view; 0: the camera's.");
    params_
        .add_choice("noise", noise_,
                    {{"camera", NoiseChoice::camera},
                     {"exact", NoiseChoice::exact},
                     {"kinect", NoiseChoice::kinect},
                     {"tof", NoiseChoice::tof}})
        .doc(
            "The noise of depths. exact: what each pixel's centre sees; kinect: axial and lateral noise of structured light; tof: noise by "
            "amplitude, flying pixels, drop-outs; camera: the one of the camera.");
    params_.add("reflectance", optics_.reflectance).range(0.01, 1).doc("Share of light that surfaces send back, for tof.");
    params_.add("disparity_step", optics_.disparity_step)
        .unit("px")
        .range(0, 1)
        .doc("Steps of the disparity for kinect, whose own are 1/8 px; 0: none.");
    params_.add("seed", seed_).range(0, 1e15).doc("Seed of the noise; it does not depend on the run's seed.");
  }

  void declare_imu() {
    params_.add("imu", has_imu_).check([this] { return contradiction(); }).doc("Whether frames carry inertial samples.");
    params_.add("imu_rate", imu_.rate_Hz).unit("Hz").range(1, 1e5).doc("Inertial samples per second.");
    params_.add("gyro_noise", imu_.gyro_noise).range(0, 10).doc("White noise of the gyroscope, rad/s/sqrt(Hz).");
    params_.add("accel_noise", imu_.accel_noise).range(0, 10).doc("White noise of the accelerometer, m/s^2/sqrt(Hz).");
    params_.add("gyro_walk", imu_.gyro_walk).range(0, 10).doc("Random walk of the gyroscope's bias, rad/s^2/sqrt(Hz).");
    params_.add("accel_walk", imu_.accel_walk).range(0, 10).doc("Random walk of the accelerometer's bias, m/s^3/sqrt(Hz).");
    params_.add("gyro_bias", imu_.gyro_bias)
        .unit("rad/s")
        .range(0, 1)
        .doc("Standard deviation of the gyroscope's bias at the start, on each axis.");
    params_.add("accel_bias", imu_.accel_bias)
        .unit("m/s^2")
        .range(0, 10)
        .doc("Standard deviation of the accelerometer's bias at the start, on each axis.");
  }
  void declare_odometry() {
    params_.add("odometry", has_odometry_).doc("Whether frames carry odometry, which drifts.");
    params_.add("odometry_t_per_m", odometry_.t_per_m)
        .range(0, 10)
        .doc("Growth of the noise of a step's translation with its length, m/m.");
    params_.add("odometry_t_per_rad", odometry_.t_per_rad)
        .range(0, 10)
        .doc("Growth of the noise of a step's translation with its turn, m/rad.");
    params_.add("odometry_r_per_m", odometry_.r_per_m)
        .range(0, 10)
        .doc("Growth of the noise of a step's rotation with its length, rad/m.");
    params_.add("odometry_r_per_rad", odometry_.r_per_rad)
        .range(0, 10)
        .doc("Growth of the noise of a step's rotation with its turn, rad/rad.");
  }
  /// What is wrong with parameters that exclude each other, or "".
  std::string contradiction() const {
    if (trajectory_.empty()) return "";
    if (!waypoints_.empty()) return "give waypoints or a trajectory, not both";
    if (has_imu_) return "poses of a trajectory have no derivatives for an inertial unit: give waypoints or a plan";
    return "";
  }

  std::unique_ptr<const FrameSequence> open_sequence() const override {
    const auto file = expand_data_path(file_);
    return std::make_unique<MeshSequence>(file.string(), read_ply_mesh(file), optics(), seed(), journey());
  }
  std::uint64_t seed() const { return static_cast<std::uint64_t>(seed_); }
  CameraJourney journey() const {
    CameraJourney out;
    std::vector<double> jumps_s;
    if (!trajectory_.empty()) {
      out.poses = read_tum(expand_data_path(trajectory_));
      if (frames_ >= 0) out.poses.resize(std::min(out.poses.size(), static_cast<std::size_t>(frames_)));
    } else {
      const CameraPath path(waypoints_.empty() ? house_plan(plan_) : read_waypoints(expand_data_path(waypoints_)), gait_);
      out.poses = sampled(path, rate_, frames_);
      jumps_s = path.jumps_s();
      if (has_imu_) out.imu = imu_.samples(path, path.duration_s(), seed());
    }
    if (has_odometry_) out.T_odom_base = odometry_.poses(out.poses, jumps_s, seed());
    return out;
  }
  MeshCamera optics() const {
    MeshCamera out = optics_;
    const Camera named = camera_of(model_);
    const int cols = cols_ ? cols_ : named.cols, rows = rows_ ? rows_ : named.rows;
    const double focal = fov_ > 0 ? cols / 2.0 / std::tan(fov_ / 2) : named.fx * cols / named.cols;
    out.camera = camera_with(cols, rows, focal);
    out.noise = noise();
    return out;
  }
  MeshCamera::Noise noise() const {
    if (noise_ == NoiseChoice::exact) return MeshCamera::Noise::exact;
    const bool kinect = noise_ == NoiseChoice::kinect || (noise_ == NoiseChoice::camera && model_ == Model::kinect320);
    return kinect ? MeshCamera::Noise::kinect : MeshCamera::Noise::tof;
  }

  std::filesystem::path file_ = "${PPM_DATA}/house.ply", waypoints_, trajectory_;
  HousePlan plan_ = HousePlan::loop;
  Gait gait_;
  double rate_ = 10, fov_ = 0;
  std::int64_t frames_ = -1, seed_ = 1;
  int cols_ = 0, rows_ = 0;
  Model model_ = Model::tof176;
  NoiseChoice noise_ = NoiseChoice::camera;
  MeshCamera optics_;
  bool has_imu_ = false, has_odometry_ = false;
  SimulatedImu imu_;
  SimulatedOdometry odometry_;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::MeshScene>("source.mesh_scene",
                        "Makes depth images of any mesh, as a time-of-flight camera or a Kinect moved through it would see it.",
                        "Lange & Seitz, IEEE JQE 2001; Nguyen, Izadi, Lovell, 3DIMPVT 2012 (cameras); Woodman 2007 (inertial unit); Thrun, Burgard, "
                        "Fox 2005 (odometry)");
}
