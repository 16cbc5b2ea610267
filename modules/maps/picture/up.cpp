#include "modules/maps/picture/up.hpp"

namespace ppm {

const std::vector<std::pair<std::string, Up>>& up_names() {
  static const std::vector<std::pair<std::string, Up>> names{
      {"auto", Up::automatic}, {"x", Up::x},        {"-x", Up::minus_x}, {"y", Up::y},
      {"-y", Up::minus_y},     {"z", Up::z},        {"-z", Up::minus_z}};
  return names;
}

Eigen::Vector3d up_direction(Up up, const Mesh& mesh, const std::vector<Pose>& path) {
  if (up == Up::automatic) return estimate_up(mesh, path);
  const int number = static_cast<int>(up) - 1;
  return Eigen::Vector3d::Unit(number / 2) * (number % 2 == 0 ? 1.0 : -1.0);
}

}  // namespace ppm
