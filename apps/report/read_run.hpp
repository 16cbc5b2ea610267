#pragma once
#include "apps/report/suite_folder.hpp"

namespace ppm::report {

/// Fills in what the run left: status, error, numbers, texts, curves, calibration and views. id, folder and command are
/// set. Throws DataError where a file of a finished run cannot be read.
void read_run(const std::filesystem::path& suite, Run& run);

}  // namespace ppm::report
