#pragma once
#include <string>
#include <vector>

namespace ppm::report {

enum class Scale { linear, logarithmic };

/// An axis from low to high.
class Axis {
 public:
  /// The smallest axis with round ends that holds the values. Logarithmic ones take the positive values alone, and go
  /// down at most six decades.
  Axis(const std::vector<double>& values, Scale scale);
  /// A linear one with given ends.
  Axis(double low, double high) : low_(low), high_(high) {}

  /// Where a value lies: 0 at the low end, 1 at the high one; clamped to that.
  double at(double value) const;
  /// Values to be marked, ascending.
  std::vector<double> ticks() const;

 private:
  double low_ = 0, high_ = 1;
  bool log_ = false;
};

/// "0.05", "20", "1500", "1e-05": as short as a tick can be.
std::string tick_text(double value);

}  // namespace ppm::report
