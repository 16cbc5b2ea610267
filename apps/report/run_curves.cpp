#include "apps/report/run_curves.hpp"

#include <cmath>

#include "apps/report/csv_table.hpp"

namespace ppm::report {

namespace {

constexpr double kMiB = 1024.0 * 1024.0;

/// The finite pairs of two columns, y scaled; empty where a column is absent.
Curve curve_of(const CsvTable& table, const std::string& x_name, const std::string& y_name, double scale) {
  Curve curve;
  const int x = table.column(x_name), y = table.column(y_name);
  if (x < 0 || y < 0) return curve;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double a = table.number(row, x), b = table.number(row, y);
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    curve.x.push_back(a);
    curve.y.push_back(scale * b);
  }
  return curve;
}

void from_zero(Curve& curve) {
  if (curve.x.empty()) return;
  const double first = curve.x.front();
  for (auto& x : curve.x) x -= first;
}

void add_holdout(const CsvTable& table, std::map<std::string, Curve>& curves) {
  const int poses = table.column("poses"), frame = table.column("frame"), error = table.column("median_mm");
  if (poses < 0 || frame < 0 || error < 0) return;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double x = table.number(row, frame), y = table.number(row, error);
    if (!std::isfinite(x) || !std::isfinite(y)) continue;  // most pixels of that frame were missed
    auto& curve = curves["holdout." + table.text(row, poses)];
    curve.x.push_back(x);
    curve.y.push_back(y);
  }
}

}  // namespace

std::map<std::string, Curve> read_curves(const std::filesystem::path& run) {
  namespace fs = std::filesystem;
  std::map<std::string, Curve> curves;
  if (const auto file = run / "trajectory_error.csv"; fs::exists(file)) {
    const CsvTable table(file);
    from_zero(curves["ate"] = curve_of(table, "stamp_s", "error_m", 100));
    from_zero(curves["ate_online"] = curve_of(table, "stamp_s", "online_error_m", 100));
  }
  if (const auto file = run / "holdout.csv"; fs::exists(file)) add_holdout(CsvTable(file), curves);
  if (const auto file = run / "metrics.csv"; fs::exists(file))
    curves["memory"] = curve_of(CsvTable(file), "frame", "map_bytes_owned", 1 / kMiB);
  if (const auto file = run / "times.csv"; fs::exists(file))
    curves["cpu_ms"] = curve_of(CsvTable(file), "frame", "cpu_ms", 1);
  std::erase_if(curves, [](const auto& entry) { return entry.second.x.empty(); });
  return curves;
}

}  // namespace ppm::report
