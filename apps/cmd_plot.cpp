#include <CLI/CLI.hpp>
#include <memory>

#include "apps/commands.hpp"
#include "apps/metrics_table.hpp"
#include "framework/config/config.hpp"
#include "framework/core/atomic_file.hpp"
#include "framework/core/error.hpp"
#include "modules/maps/picture/line_plot.hpp"
#include "modules/maps/picture/png_encoder.hpp"

namespace ppm {

namespace {

struct PlotOptions {
  std::filesystem::path run, out;
  std::vector<std::string> columns;
  int cols = PlotSettings().cols;
};

/// What tells how a filter does, of what the run recorded.
std::vector<std::string> telling(const MetricsTable& table) {
  std::vector<std::string> columns;
  for (const char* name : {"lost", "particles", "ess", "entropy", "outlier_share", "miss_weight", "innovation_mean",
                           "innovation_variance", "spread_m", "spread_deg", "coalescence_frames"}) {
    const auto column = find_column(table, name);
    if (!column.empty()) columns.push_back(column);
  }
  return columns;
}

/// The frames in which the belief was lost.
std::vector<PlotSpan> lost_spans(const MetricsTable& table) {
  std::vector<PlotSpan> spans;
  const auto lost = table.find(find_column(table, "lost"));
  if (lost == table.end()) return spans;
  bool open = false;
  for (const auto& row : lost->second) {
    if (row.y() > 0 && !open) spans.push_back({row.x(), row.x()});
    if (row.y() > 0) spans.back().last = row.x();
    open = row.y() > 0;
  }
  return spans;
}

void plot(const PlotOptions& o) {
  const auto file = o.run / "metrics.csv";
  const auto table = read_metrics(file);
  std::vector<std::string> columns;
  for (const auto& name : o.columns) {
    columns.push_back(find_column(table, name));
    if (!columns.back().empty()) continue;
    const auto nearest = did_you_mean(name, column_names(table));
    throw ConfigError(
        Place{file.string()},
        fmt::format("has no column '{}'{}", name, nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
  }
  if (columns.empty()) columns = telling(table);
  std::vector<PlotLine> lines;
  for (const auto& column : columns) lines.push_back({column, table.at(column)});
  if (lines.empty()) throw ConfigError(Place{file.string()}, "holds no column that is drawn by default; name some");
  PlotSettings settings;
  settings.cols = o.cols;
  const auto picture = o.out.empty() ? o.run / "metrics.png" : o.out;
  write_file(picture, to_png(line_plot(lines, lost_spans(table), settings)));
}

}  // namespace

void add_plot(CLI::App& app) {
  auto* command = app.add_subcommand("plot", "Draws what a run recorded frame by frame, as PNG");
  auto o = std::make_shared<PlotOptions>();
  command->add_option("run", o->run, "Folder of a run, with metrics.csv (sink.metrics)")
      ->required()
      ->type_name("FOLDER");
  command
      ->add_option(
          "columns", o->columns,
          "Columns of metrics.csv, by full name (weigh.ess) or its last part (ess); by default what tells how the "
          "filter does")
      ->type_name("COLUMN...");
  command->add_option("--out", o->out, "The picture (default: metrics.png in the run's folder)")->type_name("FILE");
  command->add_option("--width", o->cols, "Of the picture, pixels")
      ->check(CLI::Range(300, 10000))
      ->capture_default_str();
  command->footer("Frames in which the belief was lost are shaded.");
  command->callback([o] { plot(*o); });
}

}  // namespace ppm
