#include <algorithm>
#include <fmt/format.h>
#include <numeric>

#include "framework/graph/graph_builder.hpp"

namespace ppm {

namespace {

constexpr std::int64_t kAtEnd = -1;
constexpr std::int64_t kLongestPeriod = 2000;  // frames

/// The frames after which the pattern of running nodes repeats, or more than kLongestPeriod.
std::int64_t period_of(const std::vector<Node>& nodes) {
  std::int64_t period = 1;
  for (const auto& node : nodes) {
    if (period <= kLongestPeriod) period = std::lcm(period, std::min(node.gate.every, kLongestPeriod + 1));
  }
  return period;
}

/// Frames that show all that the gates can do. Between two ends of gates the pattern of running nodes is periodic, and
/// a facet that a whole period has not changed will not change: two periods and what remains are enough. Where the
/// period is very long, only the first frames are looked at.
std::vector<std::int64_t> frames_to_check(const std::vector<Node>& nodes) {
  std::vector<std::int64_t> frames;
  auto add = [&](std::int64_t begin, std::int64_t end) {
    for (auto f = begin; f < end; ++f) frames.push_back(f);
  };
  const auto period = period_of(nodes);
  if (period > kLongestPeriod) {
    add(0, 2 * kLongestPeriod);
    return frames;
  }
  std::vector<std::int64_t> ends{0};
  for (const auto& node : nodes) {
    ends.push_back(node.gate.from_frame);
    if (node.gate.until_frame != Gate::kForever) ends.push_back(node.gate.until_frame + 1);
  }
  std::ranges::sort(ends);
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const auto looked = std::min(ends[k] + 2 * period, ends[k + 1]);
    add(ends[k], looked);
    add(ends[k + 1] - (ends[k + 1] - looked) % period, ends[k + 1]);
  }
  add(ends.back(), ends.back() + 2 * period);
  return frames;
}

std::string in_words(const std::string& need) {
  if (need == "belief") return "a belief";
  if (need == "map.*") return "a map";
  if (need.starts_with("map.")) return fmt::format("a '{}' map", need.substr(4));
  if (need == "prediction.elements") return "an exact view of each particle ('prediction.elements')";
  return fmt::format("'{}' on the belief", need);
}

std::string at(std::int64_t frame) {
  return frame == kAtEnd ? "after the last frame" : fmt::format("in frame {}", frame);
}

bool gives(const Facets& facets, const std::string& need) {
  return std::ranges::any_of(facets.gives, [&](const auto& facet) { return meets(facet, need); });
}

}  // namespace

void GraphBuilder::check_facets() {
  for (const auto& node : graph_.nodes_) facets_.push_back(node.module ? facets_of(*node.module) : Facets{});
  FacetState state;
  for (auto frame : frames_to_check(graph_.nodes_)) {
    for (std::size_t i = 0; i < graph_.nodes_.size(); ++i) {
      if (graph_.nodes_[i].gate.open(frame)) enter_node(i, frame, state);
    }
  }
  for (std::size_t i = 0; i < graph_.nodes_.size(); ++i) {
    if (graph_.nodes_[i].gate.at_end) enter_node(i, kAtEnd, state);
  }
}

void GraphBuilder::enter_node(std::size_t i, std::int64_t frame, FacetState& state) {
  for (const auto& need : facets_[i].needs) {
    if (state.has(need)) continue;
    if (reported_.emplace(i, need).second) {
      auto message = missing_facet(i, need, frame, state);
      if (!message.empty()) report(written_[i].module, message);
    }
    // One message for one cause: the nodes below find it in place. Which map is meant cannot be told.
    if (need != "map.*" && !(need.starts_with("map.") && state.map_kind().second))
      state.pass({{}, {need}, {}}, i, frame);
  }
  state.pass(facets_[i], i, frame);
}

std::string GraphBuilder::missing_facet(std::size_t i, const std::string& need, std::int64_t frame,
                                        const FacetState& state) const {
  const auto& nodes = graph_.nodes_;
  const std::string subject = fmt::format("node '{}' needs {}", nodes[i].name, in_words(need));
  if (auto [kind, event] = state.map_kind(); need.starts_with("map.") && event) {
    return fmt::format("{}, but node '{}' gives '{}'", subject, nodes[event->node].name, kind);
  }
  std::size_t giver = 0;
  while (giver < nodes.size() && !gives(facets_[giver], need)) ++giver;
  if (giver == nodes.size()) return unknown_module_ ? "" : subject + never_given(need);
  const auto& name = nodes[giver].name;
  const auto& gate = nodes[giver].gate;
  if (auto* event = state.last(need)) {
    return fmt::format("{} {}, but node '{}' dropped it {}, and '{}', which gives it, {}", subject, at(frame),
                       nodes[event->node].name, at(event->frame), name,
                       giver > i ? "is below" : "does not run in between");
  }
  if (giver > i) return fmt::format("{}, but node '{}', which gives it, is below", subject, name);
  if (gate.at_end)
    return fmt::format("{} {}, but node '{}', which gives it, runs only after the last frame", subject, at(frame),
                       name);
  return fmt::format("{} {}, but node '{}', which gives it, first runs in frame {}", subject, at(frame), name,
                     gate.from_frame);
}

std::string GraphBuilder::never_given(const std::string& need) const {
  std::vector<std::string> modules;
  for (const auto* info : registry_.all()) {
    if (gives(facets_of(*info->make()), need)) modules.push_back(info->name);
  }
  if (modules.empty()) return ", which no module gives";
  return fmt::format(", which no node gives; modules that do: {}", fmt::join(modules, ", "));
}

/// Checkpoints that are asked for must be possible.
void GraphBuilder::check_map_kinds(const Config& file) {
  if (graph_.checkpoint_every_ == 0) return;
  for (std::size_t i = 0; i < graph_.nodes_.size(); ++i) {
    for (const auto& facet : facets_[i].gives) {
      if (!facet.starts_with("map.") || graph_.map_kinds_.contains(facet.substr(4))) continue;
      report(file.find("checkpoint_every")->place(),
             fmt::format("checkpoints cannot keep the maps of node '{}': no module says how maps of kind '{}' are saved",
                         graph_.nodes_[i].name, facet.substr(4)));
    }
  }
}

}  // namespace ppm
