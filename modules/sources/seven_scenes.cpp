#include <algorithm>
#include <charconv>

#include "framework/graph/registry.hpp"
#include "framework/roles/frame_source.hpp"
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
  if (error > kMaxRotationError || R.determinant() < 0)
    throw DataError(file.string(), frame,
                    fmt::format("is no pose: its rotation is not orthonormal (off by {:.2g})", error));
  return orthonormalized(T);
}

/// frame-NNNNNN.{depth.png, pose.txt, color.jpg} and camera-intrinsics.txt in one folder, in the order of their
/// numbers. An image's index is its place in that order: without gaps and from 0 on, the number itself.
class SevenScenesSequence final : public FrameSequence {
 public:
  SevenScenesSequence(const std::filesystem::path& path, double depth_scale, double rate_hz, bool color)
      : folder_(data_folder(path)), depth_scale_(depth_scale), rate_hz_(rate_hz), color_(color) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder_, error)) {
      const std::string file_name = entry.path().filename().string();
      if (auto number = frame_number(file_name)) images_.push_back({*number, file_name.substr(0, file_name.find('.'))});
    }
    if (error) throw DataError(folder_.string(), "cannot be listed: " + error.message());
    if (images_.empty()) throw DataError(folder_.string(), "has no images (frame-NNNNNN.depth.png)");
    std::sort(images_.begin(), images_.end(), [](const Image& a, const Image& b) { return a.number < b.number; });
    intrinsics_ = read_intrinsics(folder_ / "camera-intrinsics.txt");
  }

  std::string name() const override { return folder_.string(); }
  std::int64_t size() const override { return static_cast<std::int64_t>(images_.size()); }
  double stamp_s(std::int64_t index) const override { return static_cast<double>(image(index).number) / rate_hz_; }
  std::optional<Pose> reference_pose(std::int64_t index) const override {
    return read_pose(file(index, ".pose.txt"), index);
  }

  Frame read(std::int64_t index) const override {
    Frame frame;
    frame.index = index;
    frame.stamp_s = stamp_s(index);
    frame.camera = intrinsics_;
    frame.T_world_camera_ref = reference_pose(index);
    read_depth_image(file(index, ".depth.png"), depth_scale_, frame);
    if (color_) read_color_image(file(index, ".color.jpg"), frame);
    return frame;
  }

  std::vector<std::string> remarks() const override {
    std::int64_t missing = 0, gaps = 0;
    std::string where;
    for (std::size_t i = 1; i < images_.size(); ++i) {
      const std::int64_t gap = images_[i].number - images_[i - 1].number - 1;
      if (gap <= 0) continue;
      if (gaps++ == 0) where = fmt::format("after {}", images_[i - 1].stem);
      missing += gap;
    }
    if (gaps == 0) return {};
    return {fmt::format("{} images are missing in {} gaps of the numbering, the first {}", missing, gaps, where)};
  }

 private:
  struct Image {
    std::int64_t number;
    std::string stem;  // "frame-000123"
  };
  const Image& image(std::int64_t index) const { return images_[static_cast<std::size_t>(index)]; }
  std::filesystem::path file(std::int64_t index, const char* suffix) const {
    return folder_ / (image(index).stem + suffix);
  }

  std::filesystem::path folder_;
  double depth_scale_, rate_hz_;
  bool color_;
  std::vector<Image> images_;
  Camera intrinsics_;
};

/// A folder of the 7-Scenes data set, or in its layout.
/// frame   depth in m from frame-*.depth.png (0 and 65535: no return), stamp number / rate, reference pose from
/// frame-*.pose.txt
///         (camera to world, made orthonormal), color from frame-*.color.jpg if asked for
/// throws  DataError naming file and frame: no such folder, no images, no or broken intrinsics, pose or image
/// source  Shotton et al., "Scene coordinate regression forests for camera relocalization in RGB-D images", CVPR 2013
class SevenScenes final : public FrameSource {
 public:
  SevenScenes() {
    params_.add("path", path_)
        .required()
        .doc("The folder. A leading ${PPM_DATA} is replaced by that environment variable, or by ../shared/data.");
    params_.add("depth_scale", depth_scale_).above(0).doc("Depth units of the image per metre.");
    params_.add("rate", rate_hz_)
        .unit("Hz")
        .above(0)
        .doc("Images per second: an image's time is its number divided by this.");
    params_.add("color", color_)
        .doc("Also read the colour images. They are taken as they are, without registration to the depth images.");
  }

 private:
  std::unique_ptr<const FrameSequence> open_sequence() const override {
    return std::make_unique<SevenScenesSequence>(path_, depth_scale_, rate_hz_, color_);
  }

  std::filesystem::path path_;
  double depth_scale_ = 1000, rate_hz_ = 30;
  bool color_ = false;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::SevenScenes>("source.seven_scenes", "Reads depth images and poses in the layout of the 7-Scenes data set.",
                          "Shotton et al., CVPR 2013");
}
