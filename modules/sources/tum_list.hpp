#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace ppm {

/// One depth image of a TUM folder, and the colour image that goes with it.
struct TumImage {
  double stamp_s = 0;  ///< of the depth image
  std::filesystem::path depth;
  std::filesystem::path color;  ///< empty where none goes with it
};

/// The images of a folder in TUM layout, in the order of their stamps: as associations.txt pairs them ("stamp file
/// stamp file", the depth image is the one with "depth" in its path), else from depth.txt, each with the image of
/// rgb.txt that is nearest in time and at most max_dt_s away (rgb.txt is read only if there is one). Images that are
/// listed before the first or after the last one that is there are left out, and `remarks` gets a sentence. Throws
/// DataError naming file and line: no list, a malformed line, stamps that do not ascend, none of the images there.
/// Source: Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012.
std::vector<TumImage> list_tum_images(const std::filesystem::path& folder, double max_dt_s,
                                      std::vector<std::string>& remarks);

}  // namespace ppm
