#include "apps/report/not_done.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <map>

namespace ppm::report {

namespace {

/// "seeds 1 to 5 of PPM, seeds 2 to 5 of 3 graphs".
std::string on_sequence(const Comparison& c, const std::string& sequence) {
  std::map<std::string, std::vector<std::uint64_t>> by_graph;
  for (const auto& part : not_done(c))
    if (part.sequence == sequence) {
      auto& seeds = by_graph[part.graph];
      seeds.insert(seeds.end(), part.seeds.begin(), part.seeds.end());
      std::ranges::sort(seeds);
    }
  std::map<std::string, std::vector<std::string>> by_seeds;
  for (const auto& [graph, seeds] : by_graph) by_seeds[seeds_text(seeds)].push_back(graph);
  std::string text;
  for (const auto& [seeds, graphs] : by_seeds)
    text += fmt::format("{}{} of {}", text.empty() ? "" : ", ", seeds,
                        graphs.size() == 1 ? c.graph(graphs[0]).title : fmt::format("{} graphs", graphs.size()));
  return text;
}

}  // namespace

std::vector<NotDone> not_done(const Comparison& c) {
  std::vector<NotDone> parts;
  for (const auto& run : c.runs) {
    if (run.status != RunStatus::missing && run.status != RunStatus::running) continue;
    auto part = std::ranges::find_if(parts, [&](const NotDone& p) {
      return p.sequence == run.sequence && p.graph == run.graph && p.status == run.status;
    });
    if (part == parts.end()) part = parts.insert(part, {run.sequence, run.graph, run.status, {}});
    part->seeds.push_back(run.seed);
  }
  for (auto& part : parts) std::ranges::sort(part.seeds);
  return parts;
}

std::string seeds_text(const std::vector<std::uint64_t>& seeds) {
  std::string text = seeds.size() == 1 ? "seed " : "seeds ";
  for (std::size_t k = 0; k < seeds.size();) {
    std::size_t last = k;
    while (last + 1 < seeds.size() && seeds[last + 1] == seeds[last] + 1) ++last;
    if (last < k + 2) last = k;  // two in a row are named
    text += fmt::format("{}{}", k == 0 ? "" : ", ", seeds[k]);
    if (last > k) text += fmt::format(" to {}", seeds[last]);
    k = last + 1;
  }
  return text;
}

std::string not_done_sentence(const Comparison& c) {
  std::size_t count = 0;
  for (const auto& part : not_done(c)) count += part.seeds.size();
  if (count == 0) return "";
  std::string text;
  for (const auto& sequence : c.sequences)
    if (const auto part = on_sequence(c, sequence.name); !part.empty())
      text += fmt::format("{} on {} {}", text.empty() ? "" : ";", sequence.name, part);
  return fmt::format("{} of {} runs are not done:{}.", count, c.runs.size(), text);
}

}  // namespace ppm::report
