#include "apps/run_views.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/accuracy.hpp"
#include "apps/run_folder.hpp"
#include "framework/core/atomic_file.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/roles/view_predictor.hpp"
#include "modules/maps/picture/png_encoder.hpp"
#include "modules/maps/picture/view_picture.hpp"

namespace ppm {

namespace {

using Json = nlohmann::ordered_json;

/// Number and image of a view, and where pictures of it go.
struct Shot {
  std::size_t number;
  Frame frame;
  std::filesystem::path folder;
};

/// Writes a picture and returns its name.
std::string write_picture(const Shot& shot, const char* what, const RgbImage& image) {
  const auto name = fmt::format("view_{}_{}_{}.png", shot.number, shot.frame.index, what);
  write_file(shot.folder / name, to_png(image));
  return name;
}

Json write_shot(const Shot& shot, const Prediction& prediction, const std::string& poses) {
  Json json = {{"frame", shot.frame.index}};
  json["measured"] = write_picture(shot, "measured", depth_picture(shot.frame, depth_scale(shot.frame)));
  json["predicted"] = write_picture(shot, "predicted", prediction_picture(prediction));
  json["error"] = write_picture(shot, "error", error_picture(shot.frame, prediction, error_scale()));
  json["poses"] = poses;
  return json;
}

}  // namespace

std::vector<std::int64_t> frames_to_view(const std::vector<std::int64_t>& held_out, std::int64_t last, std::size_t count) {
  const auto end = std::ranges::upper_bound(held_out, last);
  const auto n = static_cast<std::size_t>(end - held_out.begin());
  count = std::min(count, n);
  std::vector<std::int64_t> frames;
  for (std::size_t k = 0; k < count; ++k) frames.push_back(held_out[(2 * k + 1) * n / (2 * count)]);
  return frames;
}

void write_views(const std::filesystem::path& folder, const Graph& graph, const std::vector<StampedPose>& path,
                 std::int64_t last, const Map* map, std::size_t count, const Workers& workers) {
  const auto* source = graph.first<FrameSource>();
  auto* predictor = map ? predictor_for(graph, *map) : nullptr;
  if (!source || !predictor) return;
  const auto frames = frames_to_view(source->held_out(), last, count);
  if (frames.empty()) return;
  const auto reference = source->reference(last);
  const auto poses =
      reference.empty() ? estimated_poses(path, source->follows_held_out()) : reference_poses(path, reference);
  predictor->prepare({map}, workers);
  std::filesystem::create_directories(folder / kViews);
  std::vector<Json> views(frames.size());
  workers.for_each(frames.size(), [&](std::size_t k, int worker) {
    const Shot shot{k, source->full_frame(frames[k]), folder / kViews};
    const auto pose = poses.T_map_camera(shot.frame);
    if (!pose) return;
    Prediction prediction;
    prediction.reset(shot.frame.camera, 1, *pose, map->color_channels());
    predictor->predict_all(*map, prediction, worker);
    views[k] = write_shot(shot, prediction, poses.name);
  });
  std::erase_if(views, [](const Json& view) { return view.is_null(); });
  write_file(folder / kViews / "views.json", Json(views).dump(2) + "\n");
}

}  // namespace ppm
