#include "framework/slam/frame.hpp"

namespace ppm {

namespace {

/// Names every member: with one more the compiler stops here, so that none is forgotten.
template <class F, class Do>
void each_member(F& frame, const Do& act) {
  auto& [index, stamp_s, camera, T_base_camera, depth, sigma, lateral_px, confidence, color, color_sigma, reference,
         imu, odometry, held_out] = frame;
  act(index), act(stamp_s), act(camera), act(T_base_camera), act(depth), act(sigma), act(lateral_px), act(confidence);
  act(color), act(color_sigma), act(reference), act(imu), act(odometry), act(held_out);
}

}  // namespace

void save(RecordWriter& out, const ImuSample& sample) {
  out.add(sample.stamp_s);
  out.add(sample.gyro);
  out.add(sample.accel);
}

void load(RecordReader& in, ImuSample& sample) {
  in.take(sample.stamp_s);
  in.take(sample.gyro);
  in.take(sample.accel);
}

void save(RecordWriter& out, const Frame& frame) {
  each_member(frame, [&](const auto& member) { out.add(member); });
}

void load(RecordReader& in, Frame& frame) {
  each_member(frame, [&](auto& member) { in.take(member); });
}

}  // namespace ppm
