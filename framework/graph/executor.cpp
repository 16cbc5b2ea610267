#include "framework/graph/executor.hpp"

#include <algorithm>

#include "framework/graph/error_context.hpp"
#include "framework/graph/facet_state.hpp"
#include "framework/graph/particle_loop.hpp"

namespace ppm {

RunSummary Executor::run(std::int64_t max_frames, const std::atomic<bool>& stop) {
  if (!opened_) open_nodes();
  const std::int64_t expected = std::min(expected_frames(), max_frames);
  watch_.reset();
  bool ended = false;
  while (!ended && !stop && summary_.frames < max_frames) {
    ended = !tick_frame(summary_.frames);
    if (ended) break;
    ++summary_.frames;
    if (on_frame) on_frame(summary_.frames, expected);
  }
  summary_.interrupted = stop && !ended && summary_.frames < max_frames;
  if (summary_.interrupted && summary_.frames > 0 && on_stop) on_stop();
  summary_.wall_s = wall_before_s_ + watch_.seconds();
  if (summary_.frames > 0) tick_at_end(summary_.frames - 1);
  close_nodes();
  return summary_;
}

void Executor::open_nodes() {
  opened_ = true;
  for (const Node& node : graph_.nodes_) {
    contexts_.push_back(context_);
    contexts_.back().enter(node.name);
    const Facets facets = facets_of(*node.module);
    prediction_use_.push_back({speak_of(facets.needs, "prediction"), speak_of(facets.gives, "prediction"),
                               speak_of(facets.drops, "prediction")});
  }
  for (std::size_t i = 0; i < contexts_.size(); ++i) {
    const Node& node = graph_.nodes_[i];
    in_node(
        node, [] { return "opening"; }, [&] { node.module->open(contexts_[i]); });
  }
}

void Executor::close_nodes() {
  for (std::size_t i = 0; i < contexts_.size(); ++i) {
    const Node& node = graph_.nodes_[i];
    in_node(
        node, [] { return "closing"; }, [&] { node.module->close(contexts_[i]); });
  }
}

bool Executor::tick_frame(std::int64_t frame) {
  for (auto& context : contexts_) context.frame_ = frame;
  auto runs = [frame](const Node& node) { return node.gate.open(frame); };
  for (std::size_t i = 0; i < graph_.nodes_.size();) {
    const Node& node = graph_.nodes_[i];
    if (!runs(node)) {
      pass_through(node);
      ++i;
    } else if (dynamic_cast<ParticleModule*>(node.module.get())) {
      i = tick_loop(i, runs, frame);
    } else {
      tick_node(i);
      if (contexts_[i].ended_) return false;
      ++i;
    }
  }
  return true;
}

void Executor::tick_at_end(std::int64_t frame) {
  for (auto& context : contexts_) context.frame_ = frame;
  auto runs = [](const Node& node) { return node.gate.at_end; };
  for (std::size_t i = 0; i < graph_.nodes_.size();) {
    const Node& node = graph_.nodes_[i];
    if (runs(node) && dynamic_cast<ParticleModule*>(node.module.get())) {
      i = tick_loop(i, runs, {});
    } else {
      if (runs(node)) tick_node(i);
      ++i;
    }
  }
}

void Executor::tick_node(std::size_t i) {
  const Node& node = graph_.nodes_[i];
  Context& context = contexts_[i];
  auto last = take_outputs(node);
  Stopwatch watch;
  in_node(
      node, [&] { return fmt::format("frame {}", context.frame()); }, [&] { node.module->tick(context); });
  if (context.ended_) {
    // The last frame's values stay, for the nodes that run at the end.
    for (auto& [port, value] : last) *port->slot_ = std::move(value);
  } else {
    summary_.nodes[node.name].ms.push_back(watch.ms());
  }
}

std::size_t Executor::tick_loop(std::size_t first, const std::function<bool(const Node&)>& runs,
                                std::optional<std::int64_t> frame) {
  ParticleLoop loop;
  std::size_t next = first;
  for (; next < graph_.nodes_.size(); ++next) {
    const Node& node = graph_.nodes_[next];
    if (!runs(node)) {
      // Without outputs it is the identity on the belief; an output must wait for what the loop makes.
      if (!has_output(node)) continue;
      break;
    }
    auto* module = dynamic_cast<ParticleModule*>(node.module.get());
    if (!module || loop.feeds(node) || (next > first && module->starts_loop())) break;
    take_outputs(node);
    loop.add(node, *module, contexts_[next]);
    if (module->ends_loop()) {
      ++next;
      break;
    }
  }
  loop.run(frame && !prediction_is_read(next, *frame) ? graph_.belief_.get() : nullptr);
  for (const auto& member : loop.members()) summary_.nodes[member.node->name].ms.push_back(member.ms);
  return next;
}

bool Executor::prediction_is_read(std::size_t next, std::int64_t frame) const {
  constexpr std::int64_t kLook = 2;  // frames: what is not decided by then is kept
  for (std::size_t i = 0; i < prediction_use_.size(); ++i)
    if (prediction_use_[i].needs && graph_.nodes_[i].gate.at_end) return true;
  for (auto f = frame; f < frame + kLook; ++f, next = 0) {
    for (std::size_t i = next; i < prediction_use_.size(); ++i) {
      if (!graph_.nodes_[i].gate.open(f)) continue;
      if (prediction_use_[i].needs) return true;
      if (prediction_use_[i].gives || prediction_use_[i].drops) return false;
    }
  }
  return true;
}

bool Executor::has_output(const Node& node) {
  return std::ranges::any_of(node.module->ports(), [](auto* p) { return p->direction() == PortDirection::out; });
}

std::vector<std::pair<PortBase*, std::shared_ptr<const void>>> Executor::take_outputs(const Node& node) {
  std::vector<std::pair<PortBase*, std::shared_ptr<const void>>> values;
  for (PortBase* port : node.module->ports()) {
    if (port->direction() == PortDirection::out) values.emplace_back(port, std::exchange(*port->slot_, nullptr));
  }
  return values;
}

void Executor::pass_through(const Node& node) {
  for (const PortBase* port : node.module->ports()) {
    if (port->direction() == PortDirection::out) *port->slot_ = *port->identity_->slot_;
  }
}

std::int64_t Executor::expected_frames() const {
  std::int64_t most = 0;
  for (const auto& context : contexts_) most = std::max(most, context.expected_frames_);
  return most;
}

}  // namespace ppm
