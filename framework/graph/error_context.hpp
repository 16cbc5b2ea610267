#pragma once
#include <exception>
#include <utility>

#include "framework/core/error.hpp"
#include "framework/graph/graph.hpp"

namespace ppm {

/// Runs f for a node. An exception leaves with the node's name and `when` added ("frame 12", "opening"): errors of ppm
/// keep their type, a ConfigError without a place gets the node's, others become Error.
template <class F, class When>
void in_node(const Node& node, const When& when, F&& f) {
  auto where = [&] { return fmt::format("node '{}', {}", node.name, when()); };
  try {
    std::forward<F>(f)();
  } catch (const ConfigError& e) {
    Diagnostics placed = e.diagnostics();
    for (auto& d : placed) {
      if (d.place.file.empty()) d.place = node.place;
    }
    ConfigError error(std::move(placed));
    error.add_context(where());
    throw error;
  } catch (Error& e) {
    e.add_context(where());
    throw;
  } catch (const std::exception& e) {
    Error error(e.what());
    error.add_context(where());
    throw error;
  }
}

}  // namespace ppm
