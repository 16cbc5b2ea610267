#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "framework/graph/module.hpp"

namespace ppm {

/// The facets of the belief on its way through the nodes of a graph, and who gave or dropped each.
class FacetState {
 public:
  struct Event {
    bool given;  ///< or dropped
    std::size_t node;
    std::int64_t frame;
  };
  /// True where a facet is there that meets the need.
  bool has(const std::string& need) const;
  /// The last thing that happened to a facet, or null.
  const Event* last(const std::string& facet) const;
  /// The kind of map that is there ("ppm"), and its event; "" and null where there is none.
  std::pair<std::string, const Event*> map_kind() const;
  /// The belief after a node. What is dropped or given anew takes its parts along: "prediction.elements" ends with
  /// "prediction".
  void pass(const Facets& facets, std::size_t node, std::int64_t frame);
  /// All facets that are there, in alphabetical order.
  std::vector<std::string> words() const;

 private:
  std::map<std::string, Event> events_;
};

/// What a module asks of the belief and does to it, over all its belief ports.
Facets facets_of(const Module& module);
/// True where a facet meets a need: the same word, or any map for "map.*".
bool meets(const std::string& facet, const std::string& need);
/// True where the facets speak of a subject: the word itself, or a part of it ("prediction.elements" of "prediction").
bool speak_of(const std::vector<std::string>& facets, const std::string& subject);

}  // namespace ppm
