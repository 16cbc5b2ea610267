#include "framework/graph/facet_state.hpp"

#include <algorithm>

namespace ppm {

namespace {
bool is_map(const std::string& facet) {
  return facet.starts_with("map.");
}
}  // namespace

bool meets(const std::string& facet, const std::string& need) {
  return facet == need || (need == "map.*" && is_map(facet));
}

bool speak_of(const std::vector<std::string>& facets, const std::string& subject) {
  return std::ranges::any_of(facets, [&](const auto& f) { return f == subject || f.starts_with(subject + "."); });
}

Facets facets_of(const Module& module) {
  Facets all;
  auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (const auto* port : module.ports()) {
    if (port->direction() != PortDirection::belief) continue;
    const auto& facets = static_cast<const BeliefPortBase*>(port)->facets();
    append(all.needs, facets.needs);
    append(all.gives, facets.gives);
    append(all.drops, facets.drops);
  }
  return all;
}

bool FacetState::has(const std::string& need) const {
  for (const auto& [facet, event] : events_) {
    if (event.given && meets(facet, need)) return true;
  }
  return false;
}

const FacetState::Event* FacetState::last(const std::string& facet) const {
  auto it = events_.find(facet);
  return it == events_.end() ? nullptr : &it->second;
}

std::pair<std::string, const FacetState::Event*> FacetState::map_kind() const {
  for (const auto& [facet, event] : events_) {
    if (event.given && is_map(facet)) return {facet.substr(4), &event};
  }
  return {"", nullptr};
}

void FacetState::pass(const Facets& facets, std::size_t node, std::int64_t frame) {
  auto drop = [&](const std::string& subject) {
    for (auto& [facet, event] : events_)
      if (event.given && speak_of({facet}, subject)) event = {false, node, frame};
  };
  for (const auto& facet : facets.drops) drop(facet);
  for (const auto& given : facets.gives) drop(is_map(given) ? "map" : given);
  for (const auto& given : facets.gives) events_[given] = {true, node, frame};
}

std::vector<std::string> FacetState::words() const {
  std::vector<std::string> words;
  for (const auto& [facet, event] : events_) {
    if (event.given) words.push_back(facet);
  }
  return words;
}

}  // namespace ppm
