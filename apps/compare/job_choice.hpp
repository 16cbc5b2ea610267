#pragma once
#include <string>
#include <vector>

#include "apps/compare/plan.hpp"

namespace ppm {

/// True where a job is meant by "comparison/sequence/graph/seed". Each part may hold * and ?; parts that are left out at the end
/// mean all. A graph is also known by the name of its folder, since [ ] are part of a swept one's name.
bool is_meant(const Job& job, const std::string& pattern);

/// The jobs in the order in which they are run: the first seed of everything first, so that a suite that is not finished yet tells
/// something of each graph, and the time that is left is known early.
std::vector<Job> in_order_of_seeds(std::vector<Job> jobs);

}  // namespace ppm
