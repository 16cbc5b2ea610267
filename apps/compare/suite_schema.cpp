#include "apps/compare/suite_schema.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace ppm {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNamePattern = "^[A-Za-z0-9_][A-Za-z0-9_.-]*$";
constexpr const char* kKeyPattern = "^[^.]+\\..+$";  // node.key

Json text(const char* description) {
  return {{"type", "string"}, {"description", description}};
}

Json quantity(const char* description) {
  return {{"type", {"number", "string"}}, {"description", description}};  // a string carries a unit: "2 GiB"
}

Json list(Json items, const char* description) {
  return {{"type", "array"}, {"items", std::move(items)}, {"description", description}};
}

Json name() {
  return {{"type", {"string", "number"}}, {"pattern", kNamePattern}, {"description", "Names folders: letters, digits, _ . and -."}};
}

Json values(const char* description, Json value = Json::object()) {
  Json schema{{"type", "object"}, {"patternProperties", {{kKeyPattern, std::move(value)}}}, {"additionalProperties", false}};
  schema["description"] = description;
  return schema;
}

Json closed(Json properties, const std::vector<std::string>& required) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"required", required}, {"additionalProperties", false}};
}

/// What suite and comparison have in common.
Json run_settings() {
  return {{"title", text("For people. Default: the name.")},
          {"seeds",
           {{"oneOf", {{{"type", "integer"}, {"minimum", 1}}, {{"type", "array"}, {"items", {{"type", "integer"}, {"minimum", 0}}}}}},
            {"description", "N for 1 .. N, or a list. Default: 1."}}},
          {"threads", {{"type", "integer"}, {"minimum", 1}, {"description", "Of each run. Default: 1."}}},
          {"views", {{"type", "integer"}, {"minimum", 0}, {"description", "Held-out frames of which each run leaves pictures. Default: 0."}}},
          {"memory", quantity("Expected of each run, until one of its kind was measured. Default: 1 GiB.")},
          {"time_limit", quantity("Of each run; one that takes longer has failed. Default: 24 h.")},
          {"drop", list({{"type", "string"}}, "Nodes that are left out of every graph, by name or module.")}};
}

Json sequence_schema() {
  return closed({{"name", name()},
                 {"title", text("For people. Default: the name.")},
                 {"nodes", list({{"type", "object"}}, "Nodes of source.*, preprocess.* and sensor.* modules, as in a graph.")},
                 {"like", text("In place of nodes: those of another graph, a file relative to the suite's.")},
                 {"frame", text("Output that the other nodes read. Default: the last node's frame.")},
                 {"seed", {{"type", {"string", "array"}}, {"items", {{"type", "string"}}}, {"description", "Parameters, node.key, that get the run's seed too."}}},
                 {"set", values("Values in place of those of the nodes.")}},
                {"name"});
}

Json graph_entry_schema() {
  return closed({{"name", name()},
                 {"title", text("For people. Default: the name.")},
                 {"graph", text("Graph file, relative to the suite's.")},
                 {"memory", quantity("Expected of each run, in place of the comparison's.")},
                 {"optional", {{"type", "boolean"}, {"description", "Left out where a module of it is not there. Default: false."}}},
                 {"replace", list({{"type", "object"}}, "Nodes in place of those of the same name.")},
                 {"add", list({{"type", "object"}, {"required", {"after"}}}, "Further nodes, each behind the node that 'after' names.")},
                 {"drop", list({{"type", "string"}}, "Nodes that are left out, by name or module.")},
                 {"set", values("Values in place of those of the graph.")},
                 {"set_for", {{"type", "object"}, {"additionalProperties", values("Values for one sequence.")}, {"description", "By sequence."}}},
                 {"sweep", values("Lists of values: a graph for every combination.", {{"type", "array"}, {"minItems", 1}})}},
                {"name", "graph"});
}

Json comparison_schema() {
  Json properties{{"name", name()}};
  properties.update(run_settings());
  properties["subject"] = text("Graph whose differences to the others are told. Default: the first.");
  properties["against"] = text("The other one that the summary names. Default: the first other.");
  properties["sequences"] = list(sequence_schema(), "Frames that every graph is run on. Default: each graph's own.");
  properties["graphs"] = list(graph_entry_schema(), "What is compared.");
  properties["skip"] = list(closed({{"graph", text("Its name.")}, {"sequence", text("Its name.")}}, {"graph", "sequence"}), "Pairs that are left out.");
  return closed(std::move(properties), {"name", "graphs"});
}

}  // namespace

std::string suite_schema() {
  Json properties{{"name", name()}};
  properties.update(run_settings());
  properties["slurm"] = {{"type", "object"},
                         {"properties",
                          {{"at_once", {{"type", "integer"}, {"minimum", 1}, {"description", "Tasks side by side. Default: no limit."}}},
                           {"options", list({{"type", "string"}}, "Further options of sbatch.")}}},
                         {"additionalProperties", false},
                         {"description", "Of the exported job array."}};
  properties["comparisons"] = list(comparison_schema(), "Each with its own graphs and sequences.");
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "ppm suite"}};
  schema.update(closed(std::move(properties), {"name", "comparisons"}));
  return schema.dump(2) + "\n";
}

}  // namespace ppm
