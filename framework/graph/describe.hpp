#pragma once
#include <map>
#include <string>

#include "framework/graph/graph.hpp"

namespace ppm {

/// A module's page for the terminal: summary, source, ports, facets, parameters.
std::string describe_text(const ModuleInfo& info);
/// The same as Markdown, for docs/modules/.
std::string describe_markdown(const ModuleInfo& info);
/// The pages of docs/modules/ by file name: one a module, and README.md, which lists them by category.
std::map<std::string, std::string> module_pages(const Registry& registry);
/// JSON Schema (draft 2020-12) of a graph file with the registry's modules, for editors.
std::string graph_schema(const Registry& registry);
/// The wiring of a graph: one line a node, its inputs, its gate, the facets of the belief after it.
std::string graph_text(const Graph& graph);
/// The same for Graphviz.
std::string graph_dot(const Graph& graph);

}  // namespace ppm
