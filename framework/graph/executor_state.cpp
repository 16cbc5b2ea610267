// What a run needs to go on: written and read by Executor::save and Executor::load.
// Records: the summary; the metrics; the state of each node; the values that nodes at the end read; the belief.
#include <algorithm>
#include <set>

#include "framework/graph/error_context.hpp"
#include "framework/graph/executor.hpp"
#include "framework/slam/belief_file.hpp"

namespace ppm {

namespace {

void save_summary(const RunSummary& summary, double wall_s, RecordFileWriter& file) {
  RecordWriter out;
  out.add(summary.frames);
  out.add(wall_s);
  out.add(summary.resumed);
  out.add(static_cast<std::uint64_t>(summary.nodes.size()));
  for (const auto& [name, times] : summary.nodes) {
    out.add(name);
    out.add(times.ms);
  }
  file.write(out);
}

RunSummary load_summary(RecordFileReader& file) {
  auto in = file.next("the summary");
  RunSummary summary;
  in.take(summary.frames);
  in.take(summary.wall_s);
  in.take(summary.resumed);
  for (auto n = in.take<std::uint64_t>(); n > 0; --n) {
    const auto name = in.take<std::string>();
    in.take(summary.nodes[name].ms);
  }
  in.finish();
  return summary;
}

}  // namespace

void Executor::save(RecordFileWriter& file) const {
  save_summary(summary_, wall_before_s_ + watch_.seconds(), file);
  RecordWriter metrics;
  context_.metrics().save(metrics);
  file.write(metrics);
  for (const Node& node : graph_.nodes_) {
    RecordWriter state;
    in_node(
        node, [] { return "saving its state"; }, [&] { node.module->save(state); });
    file.write(state);
  }
  save_values(file);
  save_belief(*graph_.belief_, graph_.map_kinds_, prediction_stands(), file);
}

void Executor::load(RecordFileReader& file) {
  summary_ = load_summary(file);
  wall_before_s_ = summary_.wall_s;
  summary_.resumed.push_back(summary_.frames);
  open_nodes();
  auto metrics = file.next("the metrics");
  context_.metrics_.load(metrics);
  metrics.finish();
  for (const Node& node : graph_.nodes_) {
    auto state = file.next(fmt::format("the state of node '{}'", node.name));
    in_node(
        node, [] { return "taking back its state"; }, [&] { node.module->load(state); });
    state.finish();
  }
  load_values(file);
  load_belief(*graph_.belief_, graph_.map_kinds_, file);
}

/// Whether the belief carries a prediction into the next frame: the last node that gave or dropped it gave it.
bool Executor::prediction_stands() const {
  for (auto frame = summary_.frames - 1; frame >= 0; --frame) {
    for (std::size_t i = prediction_use_.size(); i-- > 0;) {
      if (!graph_.nodes_[i].gate.open(frame)) continue;
      if (prediction_use_[i].gives) return true;
      if (prediction_use_[i].drops) return false;
    }
  }
  return false;
}

/// Outputs of the last frame that nodes read after the last frame, by "node.port". A run that goes on and finds no further frame
/// has no other way to them.
std::map<std::string, PortBase*> Executor::values_for_the_end() const {
  std::set<const void*> read;
  for (const Node& node : graph_.nodes_) {
    if (!node.gate.at_end) continue;
    for (const PortBase* port : node.module->ports())
      if (port->direction() == PortDirection::in) read.insert(port->slot_);
  }
  std::map<std::string, PortBase*> found;
  for (const Node& node : graph_.nodes_) {
    if (node.gate.at_end) continue;
    for (PortBase* port : node.module->ports())
      if (port->direction() == PortDirection::out && read.contains(port->slot_))
        found.emplace(fmt::format("{}.{}", node.name, port->name()), port);
  }
  return found;
}

void Executor::save_values(RecordFileWriter& file) const {
  RecordWriter out;
  for (const auto& [name, port] : values_for_the_end()) {
    const bool is_there = *port->slot_ != nullptr;
    out.add(is_there);
    if (is_there) port->save_value_(out, port->slot_->get());
  }
  file.write(out);
}

void Executor::load_values(RecordFileReader& file) {
  auto in = file.next("the values for the end");
  for (const auto& [name, port] : values_for_the_end())
    if (in.take<bool>()) *port->slot_ = port->load_value_(in);
  in.finish();
}

}  // namespace ppm
