#include "modules/maps/picture/show.hpp"

#include <algorithm>

namespace ppm {

const std::vector<std::pair<std::string, Show>>& show_names() {
  static const std::vector<std::pair<std::string, Show>> names{{"shaded", Show::shaded},
                                                               {"sigma", Show::sigma},
                                                               {"mean", Show::mean},
                                                               {"normal", Show::normal},
                                                               {"color", Show::color}};
  return names;
}

std::string to_string(Show show) {
  const auto& names = show_names();
  return std::find_if(names.begin(), names.end(), [show](const auto& n) { return n.second == show; })->first;
}

}  // namespace ppm
