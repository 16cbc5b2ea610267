#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

#include "framework/core/parallel.hpp"
#include "framework/slam/camera_parameters.hpp"
#include "framework/slam/frame_pairs.hpp"

namespace ppm {

/// A camera that makes the surfaces of many frames agree, and the poses that go with it.
struct CameraFit {
  CameraCorrection correction;
  std::vector<Pose> T_world_camera;  ///< of the frames
  std::size_t points = 0;            ///< compared, within the last gate
  double distance_before_m = 0, distance_m = 0;  ///< median between point and plane, with the camera as it was given
                                                 ///< (poses fitted) and with this one
  Eigen::MatrixXd covariance;  ///< of the parameters (see CameraParameters)
  bool converged = false;
  double sigma(Eigen::Index parameter) const { return std::sqrt(covariance(parameter, parameter)); }
};

/// Angle between the optical axes of the pairs, root mean square, rad.
double tilt_rms(const std::vector<FramePair>& pairs);
/// Throws DataError, saying what is missing, where no camera could be told from such pairs: seen along one direction, a world
/// stretched across it is as consistent as it was.
void check_observable(const std::vector<FramePair>& pairs);
/// Throws DataError where a parameter that was found is too uncertain to be of use: 1 % of the focal length, 3 pixels of
/// the principal point, 0.02 / m of a bend.
void check_found(const CameraFit& fit, const CameraParameters& parameters);

/// Joint least squares over the poses of all frames and the parameters of their camera: each pair's points are laid onto
/// each other's planes (PairSum), associated anew in every step, beyond three robust standard deviations left out. First the
/// poses alone, then all. Poses start from the frames' and are held to them by 20 cm and 0.1 rad only: they were
/// made with the camera that is in question.
/// covariance: sandwich of the normal matrix, poses marginalised, with ten stretches of successive frames as clusters of scores
/// (Cameron, Miller, "A practitioner's guide to cluster-robust inference", JHR 2015), because the errors of pixels and of
/// frames that look at one thing go together; a pair across stretches counts in both, which errs on the safe side.
/// Throws DataError where a step cannot be solved.
CameraFit fit_camera(const std::vector<CalibrationFrame>& frames, const std::vector<FramePair>& pairs,
                     const CameraCorrection& start, const CameraParameters& parameters, const Workers& workers);

}  // namespace ppm
