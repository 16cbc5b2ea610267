#include "framework/graph/gate.hpp"

namespace ppm {

void Gate::declare(Params& params) {
  constexpr double most = 1e12;  // keeps sums of frames far from overflow
  params.add("from_frame", from_frame).range(0, most).doc("First frame of the run in which the node runs, from 0.");
  params.add("until_frame", until_frame).range(0, most).doc("Last frame in which it runs.");
  params.add("every", every).range(1, most).doc("Runs in every n-th frame, counted from from_frame.");
  params.add("at_end", at_end).doc("Runs once, after the last frame; excludes the other keys.");
}

void Gate::parse(const Config* when, const Place& node, Diagnostics& out) {
  if (!when) return;
  const auto mistakes = out.size();
  Params params;
  declare(params);
  params.parse(when, "when", node, out);
  if (out.size() > mistakes) return;
  if (at_end && when->entries().size() > 1) {
    out.push_back({when->place(), "at_end excludes from_frame, until_frame and every"});
  } else if (until_frame < from_frame) {
    out.push_back(
        {when->place(), fmt::format("never runs: until_frame {} is before from_frame {}", until_frame, from_frame)});
  }
}

Config Gate::effective() const {
  Config when;
  Gate copy;  // its declaration holds the defaults
  Params params;
  copy.declare(params);
  copy = *this;
  for (const auto& spec : params.specs()) {
    if (spec.value_text() != spec.default_text()) when.set(spec.name(), {}, Config::scalar(spec.value_text(), {}));
  }
  return when;
}

}  // namespace ppm
