#pragma once
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <string>
#include <vector>

namespace ppm::test {

using MrptObjects = std::vector<mrpt::serialization::CSerializable::Ptr>;

/// Writes objects as MRPT does.
inline void write_rawlog(const std::filesystem::path& file, const MrptObjects& objects, bool compressed = false) {
  const auto write = [&](auto&& stream) {
    auto archive = mrpt::serialization::archiveFrom(stream);
    for (const auto& object : objects) archive << *object;
  };
  if (compressed)
    write(mrpt::io::CFileGZOutputStream(file.string()));
  else
    write(mrpt::io::CFileOutputStream(file.string()));
}

/// A range image of 4x3 pixels: pixel i has the value base + i, the last one none.
inline mrpt::obs::CObservation3DRangeScan::Ptr small_scan(double stamp_s, int base) {
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  scan->timestamp = mrpt::Clock::fromDouble(stamp_s);
  scan->sensorLabel = "tof";
  scan->hasRangeImage = true;
  scan->rangeImage_setSize(3, 4);
  for (int i = 0; i < 12; ++i) scan->rangeImage(i / 4, i % 4) = static_cast<std::uint16_t>(i == 11 ? 0 : base + i);
  scan->cameraParams.ncols = 4;
  scan->cameraParams.nrows = 3;
  scan->cameraParams.setIntrinsicParamsFromValues(5, 6, 1.5, 1);
  return scan;
}

}  // namespace ppm::test
