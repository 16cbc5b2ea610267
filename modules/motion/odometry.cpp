#include <cmath>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <numbers>
#include <optional>

#include "framework/graph/registry.hpp"
#include "framework/roles/motion_model.hpp"

namespace {

using namespace ppm;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

CPose3D to_mrpt(const Pose& T) {
  return CPose3D(mrpt::math::CMatrixDouble44(T.matrix()));
}

Pose from_mrpt(const CPose3D& pose) {
  return orthonormalized(pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen());
}

/// How a twist at the right of a pose changes with MRPT's coordinates of it: x, y, z, yaw, pitch, roll.
Matrix6 twist_by_coordinates(const CPose3D& pose) {
  const double sp = std::sin(pose.pitch()), cp = std::cos(pose.pitch());
  const double sr = std::sin(pose.roll()), cr = std::cos(pose.roll());
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = from_mrpt(pose).linear().transpose();
  J.bottomRightCorner<3, 3>() << -sp, 0, 1, sr * cp, cr, 0, cr * cp, -sr, 0;
  return J;
}

/// Moves each particle as odometry says that the body moved since the frame before, with noise that grows with the
/// length and the turn of the step: of the translation sigma_t + t_per_m * metres + t_per_rad * radians along each axis,
/// of the rotation sigma_r + r_per_m * metres + r_per_rad * radians about each. These are MRPT's coefficients a1 to a4
/// and least deviations (there for the plane), and the increment's Gaussian goes from the body to the camera through
/// MRPT's composition of uncertain poses.
///
/// frame    needs T_odom_base, in the frame that the map begins with too: the node runs from the first frame on
/// throws   DataError where a frame has no odometry
/// source   MRPT, mrpt::obs::CActionRobotMovement2D (Gaussian model) and mrpt::poses::CPose3DPDFGaussian; Blanco, "A
///          tutorial on SE(3) transformation parameterizations and on-manifold optimization", 2010
class OdometryMotion final : public MotionModel {
 public:
  OdometryMotion() {
    least_.declare(params_, "noise of a step without motion");
    params_.add("t_per_m", t_per_m_).range(0, 10).doc("Growth of the translation's noise with the step's length, m/m.");
    params_.add("t_per_rad", t_per_rad_)
        .range(0, 10)
        .doc("Growth of the translation's noise with the step's turn, m/rad.");
    params_.add("r_per_m", r_per_m_)
        .range(0, 10)
        .doc("Growth of the rotation's noise with the step's length, rad/m.");
    params_.add("r_per_rad", r_per_rad_)
        .range(0, 10)
        .doc("Growth of the rotation's noise with the step's turn, rad/rad.");
  }

  void begin(Context&) override { last_ = odometry(); }

  void before(Context&) override {
    const Pose T_odom_base = odometry();
    if (!last_)
      throw DataError("the source", frame->index,
                      "the odometry of the frame before is not known: the node must run from the first frame on, "
                      "without 'from_frame'");
    const Pose step = last_->inverse() * T_odom_base;
    const double metres = step.translation().norm(), radians = rotation_angle(step);
    const PoseNoise noise{least_.sigma_t + t_per_m_ * metres + t_per_rad_ * radians,
                          least_.sigma_r + r_per_m_ * metres + r_per_rad_ * radians};
    const CPose3D T_base_camera = to_mrpt(frame->T_base_camera);
    CPose3DPDFGaussian moved(to_mrpt(step), mrpt::math::CMatrixDouble66(noise.covariance()));
    moved += T_base_camera;
    moved.changeCoordinatesReference(-T_base_camera);
    const Matrix6 J = twist_by_coordinates(moved.mean);
    step_ = {from_mrpt(moved.mean), J * moved.cov.asEigen() * J.transpose()};
    last_ = T_odom_base;
  }

  MotionPrior expect(std::size_t, const Trajectory& path, const Frame&) override {
    return {path.last().T_map_camera * step_.T_map_camera, step_.covariance};
  }

  void save(RecordWriter& out) const override { out.add(last_); }
  void load(RecordReader& in) override { in.take(last_); }

 private:
  const Pose& odometry() const {
    if (!frame->T_odom_base) throw DataError("the source", frame->index, "the image comes without odometry");
    if (!is_finite(*frame->T_odom_base)) throw DataError("the source", frame->index, "the odometry is not finite");
    return *frame->T_odom_base;
  }

  PoseNoise least_{0.01, 0.2 * std::numbers::pi / 180};
  double t_per_m_ = 0.01, t_per_rad_ = 0.057, r_per_m_ = 0.017, r_per_rad_ = 0.05;
  std::optional<Pose> last_;  // T_odom_base of the frame before
  MotionPrior step_;          // of this frame: the camera now in the camera before
};

}  // namespace

PPM_MODULES(r) {
  r.add<OdometryMotion>("motion.odometry",
                        "Moves each particle as odometry says, with noise that grows with the step.",
                        "MRPT, Gaussian odometry model; Blanco, \"A tutorial on SE(3) transformation "
                        "parameterizations and on-manifold optimization\", 2010");
}
