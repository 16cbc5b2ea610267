#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <set>
#include <sstream>

#include "apps/report/html_text.hpp"
#include "apps/report/page_parts.hpp"
#include "modules/maps/picture/png_encoder.hpp"
#include "modules/maps/picture/thumbnail.hpp"

namespace ppm::report {

namespace {

using Runs = std::vector<const Run*>;

/// How a picture is shrunk for the page, which has hundreds of them; the files in the runs' folders are larger.
struct Size {
  int cols, colors;
};
constexpr Size kDepth{240, 32}, kView{180, 16}, kMap{480, 16};  // 16 colours are 4 bits a pixel

/// The first run of each graph, in the suite's order, that has what is wanted: by seed, so that no run is chosen by its
/// looks.
template <class F>
Runs first_runs(const Comparison& c, const SequenceEntry& sequence, F has) {
  Runs first;
  for (const auto& graph : c.graphs) {
    const auto runs = c.runs_of(sequence.name, graph.name);
    const auto found =
        std::ranges::find_if(runs, [&](const Run* run) { return run->status == RunStatus::done && has(*run); });
    if (found != runs.end()) first.push_back(*found);
  }
  return first;
}

/// The picture inside the page; "" where the file is absent.
std::string figure(const std::filesystem::path& file, const std::string& caption, const Size& size) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return "";
  std::ostringstream bytes;
  bytes << in.rdbuf();
  const auto png = to_png(in_palette(shrunk(from_png(bytes.str(), file.string()), size.cols), size.colors));
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
      escaped(caption), base64(png));
}

/// One held-out frame: what was measured, then each graph's prediction and its error.
std::string view_html(const Suite& suite, const Comparison& c, const Runs& runs, std::int64_t frame) {
  std::string pictures;
  bool measured = false;
  std::string poses;
  for (const auto* run : runs) {
    const auto view = std::ranges::find(run->views, frame, &View::frame);
    if (view == run->views.end()) continue;
    if (!measured) pictures += figure(suite.folder / view->measured, "measured", kDepth);
    measured = true;
    if (poses.empty()) poses = view->poses;
    const auto& title = c.graph(run->graph).title;
    pictures += figure(suite.folder / view->predicted, title + ", predicted", kView) +
                figure(suite.folder / view->error, title + ", error", kView);
  }
  return pictures.empty() ? ""
                          : fmt::format("<h4>Held-out frame {}, {} pose</h4>\n<div class=\"views\">\n{}</div>\n", frame,
                                        escaped(poses), pictures);
}

}  // namespace

std::string pictures_html(const Suite& suite, const Comparison& c, const SequenceEntry& sequence) {
  const auto seen = first_runs(c, sequence, [](const Run& run) { return !run.views.empty(); });
  std::set<std::int64_t> frames;
  for (const auto* run : seen)
    for (const auto& view : run->views) frames.insert(view.frame);
  std::string html, maps;
  for (const auto frame : frames) html += view_html(suite, c, seen, frame);
  if (!html.empty())
    html =
        "<p>Held-out frames, evenly over the sequence, as the map of each graph&#39;s first seed shows them; errors "
        "from 0 (dark blue) to 5 cm (yellow), hatched where nothing is predicted. In few colours here; the pictures in "
        "the runs&#39; folders are larger.</p>\n" +
        html;
  const auto map_of = [&](const Run& run) { return suite.folder / run.folder / "map.png"; };
  for (const auto* run : first_runs(c, sequence, [&](const Run& run) { return std::filesystem::exists(map_of(run)); }))
    maps += figure(map_of(*run), c.graph(run->graph).title, kMap);
  if (!maps.empty()) html += "<h4>Final maps</h4>\n<div class=\"maps\">\n" + maps + "</div>\n";
  return html;
}

}  // namespace ppm::report
