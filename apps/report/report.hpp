#pragma once
#include <filesystem>

namespace ppm {

/// Writes report.html, report.json, report.md and runs.csv of a suite's folder, finished or not, into it: the same
/// bytes from the same folder. Throws ConfigError where it is no such folder, DataError where a file of a finished run
/// cannot be read, OutputError.
void write_report(const std::filesystem::path& suite_folder);

}  // namespace ppm
