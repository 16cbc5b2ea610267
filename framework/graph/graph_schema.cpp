#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "framework/config/units.hpp"
#include "framework/graph/describe.hpp"
#include "framework/graph/param_text.hpp"

namespace ppm {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNamePattern = "^[A-Za-z][A-Za-z0-9_]*$";
constexpr const char* kOutputPattern = "^[A-Za-z][A-Za-z0-9_]*\\.[A-Za-z][A-Za-z0-9_]*$";

/// A limit as the parameter's type has it: JSON integers for integers.
Json limit(const ParamSpec& spec, double value) {
  if (spec.type() == ParamSpec::Type::integer) return static_cast<std::int64_t>(value);
  return value;
}

Json number_schema(const ParamSpec& spec) {
  Json schema;
  if (spec.type() == ParamSpec::Type::integer) {
    schema["type"] = "integer";
  } else {
    schema["type"] = {"number", "string"};  // a string carries a unit: "2 cm"
  }
  if (std::isfinite(spec.least())) {
    schema[spec.least_excluded() ? "exclusiveMinimum" : "minimum"] = limit(spec, spec.least());
  }
  if (std::isfinite(spec.most())) schema["maximum"] = limit(spec, spec.most());
  return schema;
}

Json type_schema(const ParamSpec& spec) {
  switch (spec.type()) {
    case ParamSpec::Type::boolean:
      return {{"type", "boolean"}};
    case ParamSpec::Type::integer:
    case ParamSpec::Type::real:
      return number_schema(spec);
    case ParamSpec::Type::text:
    case ParamSpec::Type::path:
      return {{"type", {"string", "number", "boolean"}}};  // plain YAML such as 7 is a text, too
    case ParamSpec::Type::choice:
      return {{"enum", spec.choices()}};
    case ParamSpec::Type::vector3:
      return {{"type", "array"}, {"items", number_schema(spec)}, {"minItems", 3}, {"maxItems", 3}};
  }
  PPM_CHECK(false, "type {}", static_cast<int>(spec.type()));
}

Json param_schema(const ParamSpec& spec) {
  Json schema = type_schema(spec);
  std::string text = spec.doc();
  if (!spec.unit().empty()) text += fmt::format(" Units: {}.", fmt::join(units_of(spec.unit()), ", "));
  if (!spec.is_required()) text += fmt::format(" Default: {}.", default_text(spec));
  schema["description"] = text;
  return schema;
}

Json closed_object(Json properties, const std::vector<std::string>& required) {
  Json schema{{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json params_schema(const Params& params) {
  Json properties = Json::object();
  std::vector<std::string> required;
  for (const auto& spec : params.specs()) {
    properties[spec.name()] = param_schema(spec);
    if (spec.is_required()) required.push_back(spec.name());
  }
  return closed_object(std::move(properties), required);
}

Json inputs_schema(const Module& module) {
  Json properties = Json::object();
  std::vector<std::string> required;
  for (const auto* port : module.ports()) {
    const bool use = port->direction() == PortDirection::use;
    if (!use && port->direction() != PortDirection::in) continue;
    properties[port->name()] = {
        {"type", "string"}, {"pattern", use ? kNamePattern : kOutputPattern}, {"description", port->doc()}};
    required.push_back(port->name());
  }
  return closed_object(std::move(properties), required);
}

/// What a node's other keys must be where it names this module.
Json module_rule(const ModuleInfo& info) {
  const auto module = info.make();
  Json then{{"properties", {{"params", params_schema(module->params())}, {"in", inputs_schema(*module)}}}};
  Json required = Json::array();
  for (const auto* key : {"params", "in"}) {
    if (then["properties"][key].contains("required")) required.push_back(key);
  }
  if (!required.empty()) then["required"] = required;
  return {{"if", {{"properties", {{"module", {{"const", info.name}}}}}}}, {"then", std::move(then)}};
}

Json node_schema(const Registry& registry) {
  Json modules = Json::array();
  Json rules = Json::array();
  for (const auto* info : registry.all()) {
    modules.push_back({{"const", info->name}, {"description", info->summary}});
    rules.push_back(module_rule(*info));
  }
  Gate gate;
  Params when;
  gate.declare(when);
  Json schema =
      closed_object({{"name", {{"type", "string"}, {"pattern", kNamePattern}, {"description", "Unique in the file."}}},
                     {"module", {{"oneOf", std::move(modules)}}},
                     {"in", {{"type", "object"}, {"description", "Own input: node.output above; or a node that is called."}}},
                     {"when", params_schema(when)},
                     {"params", {{"type", {"object", "null"}}}}},
                    {"name", "module"});
  schema["allOf"] = std::move(rules);
  return schema;
}

}  // namespace

std::string graph_schema(const Registry& registry) {
  Json properties{
      {"name", {{"type", "string"}, {"description", "Name of the experiment."}}},
      {"seed", {{"type", "integer"}, {"minimum", 0}, {"description", "Seed of all random numbers. Default: 0."}}},
      {"checkpoint_every",
       {{"type", "integer"},
        {"minimum", 0},
        {"description", "Frames between checkpoints, from which `ppm run --resume` goes on. Default: 0, none."}}},
      {"plugins",
       {{"type", "array"}, {"items", {{"type", "string"}}}, {"description", "Libraries of further modules."}}},
      {"nodes",
       {{"type", "array"},
        {"minItems", 1},
        {"items", {{"$ref", "#/$defs/node"}}},
        {"description", "Run from top to bottom."}}}};
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "ppm graph"}};
  schema.update(closed_object(std::move(properties), {"name", "nodes"}));
  schema["$defs"] = {{"node", node_schema(registry)}};
  return schema.dump(2) + "\n";
}

}  // namespace ppm
