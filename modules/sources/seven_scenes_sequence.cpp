#include "modules/sources/seven_scenes_sequence.hpp"

#include <algorithm>
#include <charconv>

#include "framework/core/error.hpp"
#include "modules/sources/data_path.hpp"
#include "modules/sources/depth_image.hpp"
#include "modules/sources/number_file.hpp"

namespace ppm {
namespace {

/// Deviation of R^T R from identity up to which a matrix is taken for a rotation with rounding errors.
constexpr double kMaxRotationError = 1e-2;

/// The number in "frame-000123.depth.png", or empty for other names.
std::optional<std::int64_t> frame_number(const std::string& name) {
  constexpr std::string_view kPrefix = "frame-", kSuffix = ".depth.png";
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return std::nullopt;
  const char* end = name.data() + name.size() - kSuffix.size();
  std::int64_t number = -1;
  auto [stop, error] = std::from_chars(name.data() + kPrefix.size(), end, number);
  if (error != std::errc() || stop != end || number < 0) return std::nullopt;
  return number;
}

Camera read_intrinsics(const std::filesystem::path& file) {
  const auto k = read_numbers(file, std::nullopt, 9);
  const bool matrix = k[0] > 0 && k[4] > 0 && k[1] == 0 && k[3] == 0 && k[6] == 0 && k[7] == 0 && k[8] == 1;
  if (!matrix) throw DataError(file.string(), "is no camera matrix (fx 0 cx; 0 fy cy; 0 0 1 with fx, fy > 0)");
  return {0, 0, k[0], k[4], k[2], k[5]};
}

Pose read_pose(const std::filesystem::path& file, std::int64_t frame) {
  const auto values = read_numbers(file, frame, 16);
  const Eigen::Matrix4d T = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  if (T.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw DataError(file.string(), frame, "is no pose: the last row must be 0 0 0 1");
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  const double error = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (error > kMaxRotationError)
    throw DataError(file.string(), frame,
                    fmt::format("is no pose: its rotation is not orthonormal (off by {:.2g})", error));
  if (R.determinant() < 0) throw DataError(file.string(), frame, "is no pose: it mirrors");
  return orthonormalized(T);
}

}  // namespace

SevenScenesSequence::SevenScenesSequence(const SevenScenesSettings& settings)
    : settings_(settings), folder_(data_folder(settings.path)) {
  list_images();
  camera_ = read_intrinsics(folder_ / "camera-intrinsics.txt");
  set_image_size(file(0, ".depth.png"), 0, camera_);
}

void SevenScenesSequence::list_images() {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error)) {
    const std::string file_name = entry.path().filename().string();
    if (auto number = frame_number(file_name)) images_.push_back({*number, file_name.substr(0, file_name.find('.'))});
  }
  if (error) throw DataError(folder_.string(), "cannot be listed: " + error.message());
  if (images_.empty()) throw DataError(folder_.string(), "has no images (frame-NNNNNN.depth.png)");
  std::sort(images_.begin(), images_.end(), [](const Image& a, const Image& b) { return a.number < b.number; });
}

double SevenScenesSequence::stamp_s(std::int64_t index) const {
  return static_cast<double>(image(index).number) / settings_.rate_hz;
}

std::optional<Pose> SevenScenesSequence::reference_pose(std::int64_t index) const {
  return read_pose(file(index, ".pose.txt"), index);
}

Frame SevenScenesSequence::read(std::int64_t index) const {
  Frame frame;
  frame.index = index;
  frame.stamp_s = stamp_s(index);
  frame.camera = camera_;
  frame.T_world_camera_ref = reference_pose(index);
  read_depth_image(file(index, ".depth.png"), settings_.depth_scale, frame);
  if (settings_.color) {
    read_color_image(file(index, ".color.jpg"), frame);
    if (!settings_.color_camera.is_registered()) register_color(settings_.color_camera, frame);
  }
  return frame;
}

std::vector<std::string> SevenScenesSequence::remarks() const {
  std::int64_t missing = 0, gaps = 0;
  std::string where;
  for (std::size_t i = 1; i < images_.size(); ++i) {
    const std::int64_t gap = images_[i].number - images_[i - 1].number - 1;
    if (gap <= 0) continue;
    if (gaps++ == 0) where = images_[i - 1].stem;
    missing += gap;
  }
  if (gaps == 0) return {};
  return {fmt::format("images are missing: {} in {} gaps of the numbering, the first after {}", missing, gaps, where)};
}

}  // namespace ppm
