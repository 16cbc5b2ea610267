#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <map>
#include <sstream>

#include "apps/report/html_text.hpp"
#include "apps/report/page_parts.hpp"
#include "modules/maps/picture/png_encoder.hpp"
#include "modules/maps/picture/thumbnail.hpp"

namespace ppm::report {

namespace {

using Runs = std::vector<const Run*>;

constexpr int kViewCols = 320, kMapCols = 600;  // the files in the runs' folders are larger

/// The first run of each graph, in the suite's order, that is done: by seed, so that no run is chosen by its looks.
Runs first_done(const Comparison& c, const SequenceEntry& sequence) {
  Runs first;
  for (const auto& graph : c.graphs) {
    const auto runs = c.runs_of(sequence.name, graph.name);
    const auto done = std::ranges::find(runs, RunStatus::done, &Run::status);
    if (done != runs.end()) first.push_back(*done);
  }
  return first;
}

/// The picture inside the page, at most so wide; "" where the file is absent.
std::string figure(const std::filesystem::path& file, const std::string& caption, int cols) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return "";
  std::ostringstream bytes;
  bytes << in.rdbuf();
  const auto png = to_png(shrunk(from_png(bytes.str(), file.string()), cols));
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
    if (!measured) pictures += figure(suite.folder / view->measured, "measured", kViewCols);
    measured = true;
    if (poses.empty()) poses = view->poses;
    const auto& title = c.graph(run->graph).title;
    pictures += figure(suite.folder / view->predicted, title + ", predicted", kViewCols) +
                figure(suite.folder / view->error, title + ", error", kViewCols);
  }
  return pictures.empty() ? ""
                          : fmt::format("<h4>Held-out frame {}, {} pose</h4>\n<div class=\"views\">\n{}</div>\n", frame,
                                        escaped(poses), pictures);
}

}  // namespace

std::string pictures_html(const Suite& suite, const Comparison& c, const SequenceEntry& sequence) {
  const auto runs = first_done(c, sequence);
  std::map<std::int64_t, bool> frames;
  for (const auto* run : runs)
    for (const auto& view : run->views) frames[view.frame] = true;
  std::string html, maps;
  for (const auto& [frame, seen] : frames) html += view_html(suite, c, runs, frame);
  if (!html.empty())
    html =
        "<p>Held-out frames, evenly over the sequence, as the map of each graph's first seed shows them; errors from 0 "
        "to 5 cm.</p>\n" +
        html;
  for (const auto* run : runs)
    maps += figure(suite.folder / run->folder / "map.png", c.graph(run->graph).title, kMapCols);
  if (!maps.empty()) html += "<h4>Final maps</h4>\n<div class=\"maps\">\n" + maps + "</div>\n";
  return html;
}

}  // namespace ppm::report
