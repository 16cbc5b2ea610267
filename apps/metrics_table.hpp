#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ppm {

/// The columns of a metrics.csv by name: (frame, value) of each frame that has a finite one, ascending.
using MetricsTable = std::map<std::string, std::vector<Eigen::Vector2d>>;

/// Throws DataError with file and line.
MetricsTable read_metrics(const std::filesystem::path& file);

/// The column of that full name ("weigh.ess"), or the first one whose last part it is ("ess"); "" where there is none.
std::string find_column(const MetricsTable& table, const std::string& name);
/// All names that find_column() knows.
std::vector<std::string> column_names(const MetricsTable& table);

}  // namespace ppm
