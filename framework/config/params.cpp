#include "framework/config/params.hpp"

#include <fmt/format.h>

namespace ppm {

namespace {

ParamSpec::Type type_of(const bool*) {
  return ParamSpec::Type::boolean;
}
ParamSpec::Type type_of(const int*) {
  return ParamSpec::Type::integer;
}
ParamSpec::Type type_of(const std::int64_t*) {
  return ParamSpec::Type::integer;
}
ParamSpec::Type type_of(const float*) {
  return ParamSpec::Type::real;
}
ParamSpec::Type type_of(const double*) {
  return ParamSpec::Type::real;
}
ParamSpec::Type type_of(const std::string*) {
  return ParamSpec::Type::text;
}
ParamSpec::Type type_of(const std::filesystem::path*) {
  return ParamSpec::Type::path;
}
ParamSpec::Type type_of(const Eigen::Vector3d*) {
  return ParamSpec::Type::vector3;
}
ParamSpec::Type type_of(std::monostate) {
  return ParamSpec::Type::choice;
}

std::string unknown_key(const std::string& key, const std::string& owner, const std::deque<ParamSpec>& specs) {
  std::vector<std::string> names;
  for (const auto& s : specs) names.push_back(s.name());
  if (names.empty()) return fmt::format("{} has no parameters", owner);
  const auto near = did_you_mean(key, names);
  return fmt::format(
      "{} has no parameter '{}'; {}", owner, key,
      near.empty() ? fmt::format("it has {}", fmt::join(names, ", ")) : fmt::format("did you mean '{}'?", near));
}

}  // namespace

ParamSpec& Params::declare(std::string name, ParamSpec::Target target) {
  PPM_CHECK(!find(name), "parameter '{}' is declared twice", name);
  ParamSpec spec;
  spec.name_ = std::move(name);
  spec.target_ = target;
  spec.type_ = std::visit([](auto member) { return type_of(member); }, target);
  if (!std::holds_alternative<std::monostate>(target)) spec.default_text_ = spec.value_text();
  return specs_.emplace_back(std::move(spec));
}

ParamSpec& Params::declare_choice(std::string name, std::vector<std::string> names,
                                  std::function<void(std::size_t)> set, std::function<std::size_t()> get) {
  ParamSpec& spec = declare(std::move(name), {});
  spec.choices_ = std::move(names);
  spec.set_choice_ = std::move(set);
  spec.get_choice_ = std::move(get);
  spec.default_text_ = spec.value_text();
  return spec;
}

void Params::parse(const Config* values, const std::string& owner, const Place& place, Diagnostics& out) {
  if (values && values->kind() == Config::Kind::null) values = nullptr;
  if (values && values->kind() != Config::Kind::map) {
    out.push_back({values->place(), fmt::format("the parameters of {} are a map {{name: value}}, this is a {}", owner,
                                                kind_name(values->kind()))});
    return;
  }
  if (values)
    for (const auto& entry : values->entries()) assign(entry, owner, out);
  for (const auto& spec : specs_)
    if (spec.is_required() && !(values && values->find(spec.name())))
      out.push_back({place, fmt::format("{} needs the parameter '{}'", owner, spec.name())});
}

void Params::assign(const Config::Entry& entry, const std::string& owner, Diagnostics& out) {
  for (auto& spec : specs_) {
    if (spec.name() != entry.key) continue;
    auto mistake = spec.assign(entry.value);
    if (!mistake && spec.check_) {
      if (auto wrong = spec.check_(); !wrong.empty()) mistake = Diagnostic{entry.value.place(), std::move(wrong)};
    }
    if (mistake) out.push_back({mistake->place, fmt::format("{}: {}", spec.name(), mistake->message)});
    return;
  }
  out.push_back({entry.key_place, unknown_key(entry.key, owner, specs_)});
}

const ParamSpec* Params::find(const std::string& name) const {
  for (const auto& s : specs_)
    if (s.name() == name) return &s;
  return nullptr;
}

Config Params::effective() const {
  Config map = Config::map(Place{});
  for (const auto& s : specs_) map.set(s.name(), Place{}, s.value(Place{}));
  return map;
}

}  // namespace ppm
