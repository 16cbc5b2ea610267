#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>
#include <vector>

#include "framework/core/so3.hpp"
#include "framework/graph/registry.hpp"
#include "framework/roles/motion_model.hpp"
#include "framework/slam/imu_filter.hpp"

namespace {

using namespace ppm;

constexpr const char* kColumn = "motion.imu";
constexpr double kSameTime_s = 1e-6;
constexpr double kVertical_s = 0.2;  // samples before the first image that tell the vertical

/// Moves each particle as its inertial unit felt it. Each particle carries velocity, biases and the direction of gravity
/// as a Gaussian (ImuFilter) that learns from where the particle's own path was put, frame by frame; what is not known
/// of them widens what is expected of the next pose.
///
/// frame    needs imu: samples since the image before, none missing for longer than max_gap. Those of the last 0.2 s before
///          the image that the map begins with tell the vertical, or, where the node runs from the next one on, those between
///          the two
/// metrics  of the best particle: speed (m/s), gyro_bias (rad/s), accel_bias (m/s^2), tilt_sigma (rad, of gravity),
///          distance (squared Mahalanobis, of the last settled pose against the one foretold: 6 on average where the
///          noise is right); restarts: particles that were moved by other means than motion (lost or found; slips)
/// belief   column "motion.imu", an ImuFilter a particle
/// throws   DataError where the frame's samples are missing, out of order, or not finite
/// source   Forster, Carlone, Dellaert, Scaramuzza, TRO 33(1), 2017 (preintegration)
class ImuMotionModel final : public MotionModel {
 public:
  ImuMotionModel() {
    pose_noise_.declare(params_, "error of the pose that a frame settled on");
    params_.add("gyro_noise", noise_.gyro).above(0).doc("Density of the gyroscope's white noise, rad/s/sqrt(Hz).");
    params_.add("accel_noise", noise_.accel)
        .above(0)
        .doc("Density of the accelerometer's white noise, m/s^2/sqrt(Hz).");
    params_.add("gyro_walk", noise_.gyro_walk)
        .range(0, 1)
        .doc("Density of the random walk of the gyroscope's bias, rad/s^2/sqrt(Hz).");
    params_.add("accel_walk", noise_.accel_walk)
        .range(0, 10)
        .doc("Density of the random walk of the accelerometer's bias, m/s^3/sqrt(Hz).");
    declare_start();
    params_.add("max_gap", max_gap_s_).unit("s").above(0).doc("Longest time without a sample that is allowed.");
    params_.add("gate", gate_)
        .above(0)
        .doc(
            "Squared Mahalanobis distance (6 degrees of freedom) between a settled pose and the one foretold beyond "
            "which the pose has slipped: it counts as if its noise were larger.");
    params_.add("slips", slips_)
        .range(1, 1000)
        .doc("Frames in a row that may slip. Then the settled poses are right, and velocity is unknown again.");
  }

  void begin(Context&) override {
    check_samples(*frame, frame->imu.empty() ? frame->stamp_s : frame->imu.front().stamp_s);
    before_ = frame->imu;
    std::erase_if(before_, [&](const ImuSample& s) { return s.stamp_s < frame->stamp_s - kVertical_s; });
  }

  void before(Context& context) override {
    auto& particles = *belief;
    filters_ = &particles.column<ImuFilter>(kColumn);
    begin_s_ = particles.trajectory.front().last().stamp_s;
    check_samples(*frame, begin_s_);
    distance_.assign(particles.size(), 0.0);
    T_base_camera_ = frame->T_base_camera;
    to_base_ = adjoint(T_base_camera_);
    settled_noise_ = to_base_ * pose_noise_.covariance() * to_base_.transpose();
    settle(context);
    const auto last = before_.empty() ? std::nullopt : std::optional(before_.back());
    motion_ = preintegrate(frame->imu, last, begin_s_, frame->stamp_s, mean_bias(), noise_);
    before_ = {frame->imu.back()};
    was_lost_ = particles.lost;
  }

  MotionPrior expect(std::size_t i, const Trajectory&, const Frame&) override {
    ImuFilter& filter = (*filters_)[i];
    filter.predict(motion_, noise_);
    const Eigen::Matrix<double, 6, 6> to_camera = adjoint(T_base_camera_.inverse());
    const Matrix6 spread = filter.covariance.topLeftCorner<6, 6>() + settled_noise_;
    return {filter.T_map_base * T_base_camera_, to_camera * spread * to_camera.transpose()};
  }

  void save(RecordWriter& out) const override {
    out.add(before_);
    out.add(was_lost_);
  }
  void load(RecordReader& in) override {
    in.take(before_);
    in.take(was_lost_);
  }

 private:
  void declare_start();
  void check_samples(const Frame& now, double begin_s) const;
  ImuBias mean_bias() const;
  void settle(Context& context);
  bool settle(ImuFilter& filter, const Pose& T_map_base, const Matrix6& noise, double& distance) const;
  Matrix6 noise_of_seen(const Matrix6& information) const;

  ImuNoise noise_;
  ImuStart start_;
  PoseNoise pose_noise_{0.002, 0.002};
  double max_gap_s_ = 0.1, gate_ = 17;
  int slips_ = 5;

  std::vector<ImuSample> before_;  // the frame's before: of the one that the map began with all, else the last
  bool was_lost_ = false;          // in the frame before
  // Of this frame.
  Column<ImuFilter>* filters_ = nullptr;
  double begin_s_ = 0;
  Pose T_base_camera_ = Pose::Identity();
  Matrix6 to_base_ = Matrix6::Identity();    // a twist of the camera as one of the body
  Matrix6 settled_noise_ = Matrix6::Zero();  // of a settled pose, as a twist of the body
  ImuMotion motion_;
  std::vector<double> distance_;
};

void ImuMotionModel::declare_start() {
  params_.add("start_speed", start_.speed)
      .unit("m/s")
      .range(0, 1000)
      .doc("Standard deviation of the velocity at the start, along each axis; it is taken to be zero.");
  params_.add("start_accel", start_.accel)
      .unit("m/s^2")
      .range(0, 100)
      .doc("Standard deviation of the body's own acceleration at the start; it is taken to be zero.");
  params_.add("start_gyro_bias", start_.gyro_bias)
      .unit("rad/s")
      .range(0, 1)
      .doc("Standard deviation of the gyroscope's bias at the start.");
  params_.add("start_accel_bias", start_.accel_bias)
      .unit("m/s^2")
      .range(0, 10)
      .doc("Standard deviation of the accelerometer's bias at the start.");
}

void ImuMotionModel::check_samples(const Frame& now, double begin_s) const {
  const auto fail = [&](const std::string& reason) { throw DataError("the source", now.index, reason); };
  if (now.imu.empty()) fail("the image comes without inertial samples");
  double at_s = begin_s;
  for (const auto& sample : now.imu) {
    if (!sample.gyro.allFinite() || !sample.accel.allFinite()) fail("an inertial sample is not finite");
    if (!(sample.stamp_s >= at_s) || sample.stamp_s > now.stamp_s)
      fail(fmt::format("the inertial sample of {} s is not between {} s and the image's {} s", sample.stamp_s, at_s,
                       now.stamp_s));
    if (sample.stamp_s - at_s > max_gap_s_)
      fail(fmt::format("no inertial sample from {} s to {} s (max_gap)", at_s, sample.stamp_s));
    at_s = sample.stamp_s;
  }
  if (now.stamp_s - at_s > max_gap_s_)
    fail(fmt::format("no inertial sample from {} s to the image's {} s (max_gap)", at_s, now.stamp_s));
}

/// The weighted mean over the particles, near which the motion is linearised; in fixed order.
ImuBias ImuMotionModel::mean_bias() const {
  ImuBias mean;
  for (std::size_t i = 0; i < filters_->values.size(); ++i) {
    const double w = std::exp(belief->log_weight[i]);
    mean.gyro += w * (*filters_)[i].bias.gyro;
    mean.accel += w * (*filters_)[i].bias.accel;
  }
  return mean;
}

/// What the frame before taught, now that it is over.
void ImuMotionModel::settle(Context& context) {
  auto& particles = *belief;
  std::vector<char> restarted(particles.size(), 0);
  const bool looked = particles.columns().contains(kMotionSeenColumn);
  const auto* seen = looked ? &particles.column<Matrix6>(kMotionSeenColumn) : nullptr;
  context.workers().for_each(particles.size(), [&](std::size_t i, int) {
    const Pose T_map_base = particles.trajectory[i].last().T_map_camera * T_base_camera_.inverse();
    const Matrix6 noise = seen ? settled_noise_ + noise_of_seen((*seen)[i]) : settled_noise_;
    restarted[i] = settle((*filters_)[i], T_map_base, noise, distance_[i]);
  });
  double restarts = 0;
  for (const char r : restarted) restarts += r;
  const std::size_t best = particles.best();
  const ImuFilter& filter = (*filters_)[best];
  context.metric("speed", filter.velocity.norm());
  context.metric("gyro_bias", filter.bias.gyro.norm());
  context.metric("accel_bias", filter.bias.accel.norm());
  context.metric("tilt_sigma", std::sqrt(filter.covariance.bottomRightCorner<3, 3>().trace()) / ImuFilter::kGravity);
  context.metric("distance", distance_[best]);
  context.metric("restarts", restarts);
}

/// Along a bare wall the pose that a frame settles on is a draw of the prior: what the image did not say teaches nothing.
Matrix6 ImuMotionModel::noise_of_seen(const Matrix6& information) const {
  constexpr double kLeast = 1e-2;  // of (10 m)^2, (10 rad)^2: nothing
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(information);
  const Twist variance = eigen.eigenvalues().cwiseMax(kLeast).cwiseInverse();
  const Matrix6 axes = to_base_ * eigen.eigenvectors();
  return axes * variance.asDiagonal() * axes.transpose();
}

/// Whether the particle was moved by other means than motion: its velocity is then unknown again.
bool ImuMotionModel::settle(ImuFilter& filter, const Pose& T_map_base, const Matrix6& noise, double& distance) const {
  if (!filter.begun()) {
    filter.begin(begin_s_, T_map_base, before_.empty() ? frame->imu : before_, settled_noise_, start_);
    return false;
  }
  distance = filter.distance(T_map_base, noise);
  filter.correct_at_most(T_map_base, noise, gate_);
  const bool followed = std::abs(filter.stamp_s - begin_s_) < kSameTime_s;
  if (followed && !belief->lost && !was_lost_ && filter.slips <= slips_) return false;
  filter.restart(begin_s_, T_map_base, settled_noise_, start_);
  return true;
}

}  // namespace

PPM_MODULES(r) {
  r.add<ImuMotionModel>("motion.imu",
                        "Moves each particle by gyroscope and accelerometer, whose biases it learns from its own path.",
                        "Forster, Carlone, Dellaert, Scaramuzza, \"On-manifold preintegration for real-time "
                        "visual-inertial odometry\", IEEE Transactions on Robotics 33(1), 2017");
}
