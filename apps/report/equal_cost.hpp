#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/report/suite_folder.hpp"

namespace ppm::report {

/// What a graph costs (bytes, or time) and how far it errs: medians over seeds, positive and finite.
struct CostPoint {
  std::string graph;
  double cost, error;
};

/// The points that no other beats in both, ascending in cost, so descending in error.
std::vector<CostPoint> front_of(std::vector<CostPoint> points);

enum class Bound { exact, at_most, at_least };
/// A number read off a front, or a bound of it where the front does not reach.
struct Reading {
  double value;
  Bound bound;
};

/// The error of a front at a cost: straight lines between its points in logarithms of both. A front is not continued:
/// below its cheapest point the error is at least that point's, beyond its dearest at most that one's.
Reading error_at(const std::vector<CostPoint>& front, double cost);
/// The cost of a front at an error, likewise.
Reading cost_at(const std::vector<CostPoint>& front, double error);

/// The subject against a kind of map, all of whose graphs on one sequence make the front.
struct EqualCost {
  std::string sequence, rival;  ///< rival: kind of map, or family of graphs where that is the subject's own
  std::string cost;             ///< "memory" or "time"
  std::vector<CostPoint> front;
  CostPoint subject;
  Reading rival_error;  ///< at the subject's cost
  Reading rival_cost;   ///< at the subject's error

  /// Subject's over rival's: smaller is better for the subject.
  Reading error_ratio() const;
  Reading cost_ratio() const;
};

/// Key of the error that fronts are made of: the held-out median, from the filter's own poses where there are any.
const char* error_key(const Comparison& comparison);
/// Median error and cost of a graph on a sequence.
std::optional<CostPoint> cost_point(const Comparison& comparison, const std::string& sequence, const std::string& graph,
                                    const std::string& cost);
/// Who stands on one front with a graph: those of its kind of map, or of its family where the subject has that kind
/// too.
std::string rival_of(const Comparison& comparison, const std::string& graph);
/// Every sequence, rival and cost.
std::vector<EqualCost> equal_costs(const Comparison& comparison);

}  // namespace ppm::report
