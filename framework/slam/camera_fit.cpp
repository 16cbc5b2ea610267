#include "framework/slam/camera_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/core/error.hpp"
#include "framework/core/timing.hpp"
#include "framework/slam/pair_sum.hpp"

namespace ppm {
namespace {

constexpr std::size_t kStretches = 10;
constexpr double kLeastTilt_deg = 3;
constexpr double kMedianToSigma = 1.4826;
constexpr double kGate = 3;  // robust standard deviations
constexpr double kPriorMetres = 0.2, kPriorRadians = 0.1;
constexpr int kMostSteps = 30, kPoseSteps = 8;
constexpr double kStepEnd = 0.1;  // of a standard deviation (points taken as independent), by which steps end

/// The state of the iteration.
class Problem {
 public:
  Problem(const std::vector<CalibrationFrame>& frames, const std::vector<FramePair>& pairs, const CameraCorrection& start,
          const CameraParameters& parameters, const Workers& workers)
      : frames_(frames), pairs_(pairs), parameters_(parameters), workers_(workers), correction_(start) {
    for (const auto& f : frames) pose_.push_back(f.T_world_camera);
  }

  /// Sums over all pairs at the present state. distance_m: of the gate.
  void sum(double distance_m) {
    std::vector<PlacedFrame> placed;
    placed.reserve(frames_.size());
    for (const auto& f : frames_) placed.emplace_back(f.patches, correction_, parameters_);
    PairGate gate;
    gate.distance_m = distance_m;
    gate.deviations = scale_ > 0 ? kGate * scale_ : gate.deviations;
    sums_.resize(pairs_.size());
    workers_.for_each(pairs_.size(), [&](std::size_t k, int) {
      const auto [i, j] = std::pair(pairs_[k].first, pairs_[k].second);
      sums_[k] = sum_pair(placed[i], pose_[i], placed[j], pose_[j], gate);
    });
    measure();
    assemble();
  }
  /// One Gauss-Newton step. Returns its length in the camera's parameters, standard deviations of independent points.
  double step(bool with_camera) {
    const Eigen::Index poses = pose_variables(), n = with_camera ? H_.rows() : poses;
    const Eigen::LDLT<Eigen::MatrixXd> solver(H_.topLeftCorner(n, n));
    const Eigen::VectorXd x = solver.solve(b_.head(n));
    if (solver.info() != Eigen::Success || !x.allFinite())
      throw DataError("the calibration", "the frames do not hold together: a step cannot be solved");
    for (std::size_t i = 0; i < pose_.size(); ++i)
      pose_[i] = pose_[i] * se3_exp(x.segment<6>(6 * static_cast<Eigen::Index>(i)));
    if (!with_camera) return 0;
    const Eigen::VectorXd camera = x.tail(parameters_.size());
    correction_ = parameters_.moved(correction_, camera);
    return std::sqrt(camera.dot(information() * camera)) / scale_;
  }
  /// Of the camera's parameters, poses marginalised. Weights as they are: not scaled by the residuals.
  Eigen::MatrixXd information() const {
    const Eigen::Index poses = pose_variables(), p = parameters_.size();
    const Eigen::MatrixXd across = H_.topLeftCorner(poses, poses).ldlt().solve(H_.topRightCorner(poses, p));
    return H_.bottomRightCorner(p, p) - H_.bottomLeftCorner(p, poses) * across;
  }
  /// What remains of each pair's score in the camera's parameters once the poses have had their share, summed
  /// over the pairs that touch each of kStretches stretches of successive frames.
  std::vector<Eigen::VectorXd> scores() const {
    const Eigen::Index poses = pose_variables(), p = parameters_.size();
    const Eigen::MatrixXd across = H_.topLeftCorner(poses, poses).ldlt().solve(H_.topRightCorner(poses, p));
    auto stretch = [&](std::size_t frame) { return frame * kStretches / frames_.size(); };
    std::vector<Eigen::VectorXd> out(kStretches, Eigen::VectorXd::Zero(p));
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(pairs_[k].first), j = static_cast<Eigen::Index>(pairs_[k].second);
      const Eigen::VectorXd& b = sums_[k].b;
      const Eigen::VectorXd score = b.tail(p) - across.middleRows<6>(6 * i).transpose() * b.head<6>() -
                                    across.middleRows<6>(6 * j).transpose() * b.segment<6>(6);
      const std::size_t first = stretch(pairs_[k].first), second = stretch(pairs_[k].second);
      out[first] += score;
      if (second != first) out[second] += score;
    }
    return out;
  }
  const CameraCorrection& correction() const { return correction_; }
  const std::vector<Pose>& poses() const { return pose_; }
  double median_m() const { return median_m_; }
  double scale() const { return scale_; }
  std::size_t points() const { return points_; }

 private:
  Eigen::Index pose_variables() const { return 6 * static_cast<Eigen::Index>(pose_.size()); }
  void measure() {
    std::vector<double> deviations, distances;
    points_ = 0;
    for (const auto& s : sums_) {
      deviations.insert(deviations.end(), s.deviation.begin(), s.deviation.end());
      distances.insert(distances.end(), s.distance_m.begin(), s.distance_m.end());
      points_ += s.points;
    }
    if (deviations.empty()) throw DataError("the calibration", "no point of a frame lies on another frame's surface");
    scale_ = kMedianToSigma * quantile(std::move(deviations), 0.5);
    median_m_ = quantile(std::move(distances), 0.5);
  }
  void assemble() {
    const Eigen::Index p = parameters_.size(), poses = pose_variables();
    H_ = Eigen::MatrixXd::Zero(poses + p, poses + p);
    b_ = Eigen::VectorXd::Zero(poses + p);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const Eigen::Index at[3] = {6 * static_cast<Eigen::Index>(pairs_[k].first),
                                  6 * static_cast<Eigen::Index>(pairs_[k].second), poses};
      const Eigen::Index from[3] = {0, 6, 12}, size[3] = {6, 6, p};
      for (int r = 0; r < 3; ++r) {
        b_.segment(at[r], size[r]) += sums_[k].b.segment(from[r], size[r]);
        for (int c = 0; c < 3; ++c)
          H_.block(at[r], at[c], size[r], size[c]) += sums_[k].H.block(from[r], from[c], size[r], size[c]);
      }
    }
    hold_to_start();
  }
  void hold_to_start() {
    Twist prior;
    prior << Eigen::Vector3d::Constant(std::pow(kPriorMetres, -2)), Eigen::Vector3d::Constant(std::pow(kPriorRadians, -2));
    for (std::size_t i = 0; i < pose_.size(); ++i) {
      const auto at = 6 * static_cast<Eigen::Index>(i);
      H_.diagonal().segment<6>(at) += prior;
      b_.segment<6>(at) -= prior.cwiseProduct(se3_log(frames_[i].T_world_camera.inverse() * pose_[i]));
    }
  }

  const std::vector<CalibrationFrame>& frames_;
  const std::vector<FramePair>& pairs_;
  const CameraParameters& parameters_;
  const Workers& workers_;
  CameraCorrection correction_;
  std::vector<Pose> pose_;
  std::vector<PairSum> sums_;
  Eigen::MatrixXd H_;
  Eigen::VectorXd b_;
  double scale_ = 0, median_m_ = 0;
  std::size_t points_ = 0;
};

/// Largest standard deviation of what is of use.
double most_uncertain(CameraParameter parameter) {
  switch (parameter) {
    case CameraParameter::focal: return 0.01;
    case CameraParameter::cx:
    case CameraParameter::cy: return 3;
    default: return 0.02;
  }
}

}  // namespace

double tilt_rms(const std::vector<FramePair>& pairs) {
  double sum = 0;
  for (const auto& p : pairs) sum += p.tilt_rad * p.tilt_rad;
  return pairs.empty() ? 0 : std::sqrt(sum / static_cast<double>(pairs.size()));
}

void check_observable(const std::vector<FramePair>& pairs) {
  const double degrees = tilt_rms(pairs) * 180 / std::numbers::pi;
  if (degrees < kLeastTilt_deg)
    throw DataError("the calibration",
                    fmt::format("the focal length cannot be seen: frames that see the same surface look along axes only {:.1f} "
                                "degrees apart (root mean square; it takes {}), and along one axis every focal length fits",
                                degrees, kLeastTilt_deg));
}

void check_found(const CameraFit& fit, const CameraParameters& parameters) {
  for (Eigen::Index k = 0; k < parameters.size(); ++k) {
    const auto p = parameters.free[static_cast<std::size_t>(k)];
    if (!(fit.sigma(k) < most_uncertain(p)))
      throw DataError("the calibration",
                      fmt::format("{} cannot be told from these frames: its standard deviation is {:.3g}, and more than {:.3g} is of "
                                  "no use; it takes more frames, or more different views of the same surfaces",
                                  to_string(p), fit.sigma(k), most_uncertain(p)));
  }
}

CameraFit fit_camera(const std::vector<CalibrationFrame>& frames, const std::vector<FramePair>& pairs,
                     const CameraCorrection& start, const CameraParameters& parameters, const Workers& workers) {
  Problem problem(frames, pairs, start, parameters, workers);
  auto gate_m = [](int k) { return std::max(0.03, 0.2 * std::pow(0.7, k)); };
  for (int k = 0; k < kPoseSteps; ++k) {
    problem.sum(gate_m(k));
    problem.step(false);
  }
  problem.sum(gate_m(kPoseSteps));
  CameraFit fit;
  fit.distance_before_m = problem.median_m();
  for (int k = 0; k < kMostSteps && !fit.converged; ++k) {
    fit.converged = problem.step(true) < kStepEnd;
    problem.sum(gate_m(kPoseSteps));
  }
  fit.correction = problem.correction();
  fit.T_world_camera = problem.poses();
  fit.points = problem.points();
  fit.distance_m = problem.median_m();
  const Eigen::MatrixXd inverse = problem.information().inverse();
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(parameters.size(), parameters.size());
  for (const auto& s : problem.scores()) scores += s * s.transpose();
  fit.covariance = inverse * scores * inverse * kStretches / (kStretches - 1.0);
  return fit;
}

}  // namespace ppm
