#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "framework/config/config.hpp"

namespace ppm {

/// One declared parameter: what it is called, where its value goes, what is allowed. Built by Params::add. A
/// declaration that makes no sense (an unknown unit, a range for a text, a default that is not finite) throws
/// InternalError.
class ParamSpec {
 public:
  enum class Type { boolean, integer, real, text, path, choice, vector3 };

  ParamSpec& unit(std::string si_unit);                ///< see parse_quantity; reals and vectors only
  ParamSpec& range(double least, double most);         ///< both ends allowed, SI
  ParamSpec& above(double least);                      ///< strictly above, SI
  ParamSpec& doc(std::string text);                    ///< one or more sentences, ends with a full stop
  ParamSpec& required();                               ///< has no default
  ParamSpec& choices(std::vector<std::string> names);  ///< for texts; the type becomes choice
  /// A further check of a value that was given: looks at the bound member, returns "" or what is wrong.
  ParamSpec& check(std::function<std::string()> f);

  const std::string& name() const { return name_; }
  Type type() const { return type_; }
  const std::string& unit() const { return unit_; }
  const std::string& doc() const { return doc_; }
  double least() const { return least_; }
  double most() const { return most_; }
  bool least_excluded() const { return least_excluded_; }
  bool is_required() const { return required_; }
  const std::vector<std::string>& choices() const { return choices_; }
  /// The default as the constructor's initialiser had it, as YAML text in SI units ("0.02"); "" for a required one.
  const std::string& default_text() const { return default_text_; }
  /// The value in force, as YAML text.
  std::string value_text() const;

 private:
  friend class Params;
  using Target = std::variant<std::monostate, bool*, int*, std::int64_t*, double*, float*, std::string*, std::filesystem::path*,
                              Eigen::Vector3d*>;
  /// Sets the bound value, or says what is wrong and where; the value is unchanged then.
  std::optional<Diagnostic> assign(const Config& value);
  std::string assign_real(const Config& value);
  std::string assign_boolean(const Config& value);
  std::string assign_integer(const Config& value);
  std::string assign_text(const Config& value);
  std::optional<Diagnostic> assign_vector(const Config& value);
  std::string read_real(const Config& value, double& out) const;
  std::string check_range(double value, const std::string& written) const;
  Config value(const Place& place) const;

  std::string name_, unit_, doc_, default_text_;
  Type type_ = Type::text;
  Target target_;
  double least_ = -std::numeric_limits<double>::infinity();
  double most_ = std::numeric_limits<double>::infinity();
  bool least_excluded_ = false, required_ = false;
  std::vector<std::string> choices_;
  std::function<std::string()> check_;
  // An enum's member is set through the choice's index; target_ is empty then.
  std::function<void(std::size_t)> set_choice_;
  std::function<std::size_t()> get_choice_;
};

/// The parameters of a module, declared once, each bound to the member that holds it; the member's initialiser is the
/// default. From this one declaration come parsing, checks, `ppm describe`, the schema, the docs page and the effective
/// values.
class Params {
 public:
  /// T: bool, int, std::int64_t, double, float, std::string, std::filesystem::path, Eigen::Vector3d.
  template <class T>
  ParamSpec& add(std::string name, T& member) {
    return declare(std::move(name), ParamSpec::Target(&member));
  }
  /// An enum, written in YAML by name.
  template <class E>
  ParamSpec& add_choice(std::string name, E& member, std::vector<std::pair<std::string, E>> named);

  /// Assigns each value of a YAML map (or null) to its member. Appends every mistake to `out` (unknown key with "did
  /// you mean", wrong type, unit or range, missing required value) and goes on. owner: the module's name for messages;
  /// place: where the node stands, for a missing required value.
  void parse(const Config* values, const std::string& owner, const Place& place, Diagnostics& out);
  const std::deque<ParamSpec>& specs() const { return specs_; }
  const ParamSpec* find(const std::string& name) const;
  /// The values in force, as a YAML map.
  Config effective() const;

 private:
  void assign(const Config::Entry& entry, const std::string& owner, Diagnostics& out);
  ParamSpec& declare(std::string name, ParamSpec::Target target);
  ParamSpec& declare_choice(std::string name, std::vector<std::string> names, std::function<void(std::size_t)> set,
                            std::function<std::size_t()> get);
  std::deque<ParamSpec> specs_;  // references stay valid
};

template <class E>
ParamSpec& Params::add_choice(std::string name, E& member, std::vector<std::pair<std::string, E>> named) {
  std::vector<std::string> names;
  for (const auto& n : named) names.push_back(n.first);
  auto set = [&member, named](std::size_t i) { member = named[i].second; };
  auto get = [&member, named] {
    for (std::size_t i = 0; i < named.size(); ++i)
      if (named[i].second == member) return i;
    return named.size();
  };
  return declare_choice(std::move(name), std::move(names), set, get);
}

}  // namespace ppm
