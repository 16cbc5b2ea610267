#include <charconv>
#include <cmath>
#include <fmt/format.h>

#include "framework/config/params.hpp"
#include "framework/config/units.hpp"

namespace ppm {

namespace {

template <class Real>
std::string number_text(Real value) {
  PPM_CHECK(std::isfinite(value), "a parameter's value is not finite");
  return fmt::format("{}", value);
}

/// What is wrong with a value that must be one plain word, or "".
std::string refuse_non_plain(const Config& value, const std::string& wanted) {
  if (value.kind() == Config::Kind::null) return fmt::format("no value is given; {} is wanted", wanted);
  if (value.kind() != Config::Kind::scalar)
    return fmt::format("this is a {}; {} is wanted", kind_name(value.kind()), wanted);
  if (value.quoted()) return fmt::format("\"{}\" is a text in quotes; {} is wanted", value.text(), wanted);
  return "";
}

}  // namespace

ParamSpec& ParamSpec::unit(std::string si_unit) {
  PPM_CHECK(type_ == Type::real || type_ == Type::vector3, "'{}' cannot have a unit", name_);
  PPM_CHECK(is_si_unit(si_unit), "'{}' has the unknown SI unit '{}'", name_, si_unit);
  unit_ = std::move(si_unit);
  return *this;
}

ParamSpec& ParamSpec::range(double least, double most) {
  PPM_CHECK(type_ == Type::real || type_ == Type::integer || type_ == Type::vector3, "'{}' cannot have a range", name_);
  PPM_CHECK(least <= most, "'{}' has an empty range", name_);
  least_ = least;
  most_ = most;
  least_excluded_ = false;
  return *this;
}

ParamSpec& ParamSpec::above(double least) {
  range(least, most_);
  least_excluded_ = true;
  return *this;
}

ParamSpec& ParamSpec::doc(std::string text) {
  doc_ = std::move(text);
  return *this;
}

ParamSpec& ParamSpec::required() {
  required_ = true;
  default_text_.clear();
  return *this;
}

ParamSpec& ParamSpec::choices(std::vector<std::string> names) {
  PPM_CHECK(type_ == Type::text, "'{}' cannot have choices: it is not a text", name_);
  type_ = Type::choice;
  choices_ = std::move(names);
  return *this;
}

ParamSpec& ParamSpec::check(std::function<std::string()> f) {
  check_ = std::move(f);
  return *this;
}

std::string ParamSpec::check_range(double value, const std::string& written) const {
  const bool low = least_excluded_ ? value <= least_ : value < least_;
  if (!low && value <= most_) return "";
  const std::string unit = unit_.empty() ? "" : " " + unit_;
  if (std::isinf(most_))
    return fmt::format("'{}' must be {} {}{}", written, least_excluded_ ? "above" : "at least", least_, unit);
  if (std::isinf(least_)) return fmt::format("'{}' must be at most {}{}", written, most_, unit);
  return fmt::format("'{}' is out of range: {} {}{} to {}{}", written, least_excluded_ ? "above" : "from", least_, unit,
                     most_, unit);
}

std::string ParamSpec::read_real(const Config& value, double& out) const {
  if (auto wrong = refuse_non_plain(value, unit_.empty() ? "a number" : "a number (" + unit_ + ")"); !wrong.empty())
    return wrong;
  double number = 0;
  if (auto wrong = parse_quantity(value.text(), unit_, number); !wrong.empty()) return wrong;
  if (auto wrong = check_range(number, value.text()); !wrong.empty()) return wrong;
  out = number;
  return "";
}

std::string ParamSpec::assign_real(const Config& value) {
  if (auto* target = std::get_if<double*>(&target_)) return read_real(value, **target);
  double number = 0;
  auto wrong = read_real(value, number);
  if (wrong.empty()) *std::get<float*>(target_) = static_cast<float>(number);
  return wrong;
}

std::string ParamSpec::assign_boolean(const Config& value) {
  if (auto wrong = refuse_non_plain(value, "true or false"); !wrong.empty()) return wrong;
  if (value.text() != "true" && value.text() != "false")
    return fmt::format("'{}' is not a boolean: write true or false", value.text());
  *std::get<bool*>(target_) = value.text() == "true";
  return "";
}

std::string ParamSpec::assign_integer(const Config& value) {
  if (auto wrong = refuse_non_plain(value, "an integer"); !wrong.empty()) return wrong;
  const std::string& text = value.text();
  const std::size_t sign = text.find_first_not_of("+-") == 1 ? 1 : 0;
  if (text.size() == sign || text.find_first_not_of("0123456789", sign) != std::string::npos)
    return fmt::format("'{}' is not an integer", text);
  if (text.size() > sign + 1 && text[sign] == '0')
    return fmt::format("'{}' has a leading zero, which YAML 1.1 reads as octal: write it without", text);
  std::int64_t number = 0;
  const char* begin = text.data() + (text[0] == '+' ? 1 : 0);
  const auto error = std::from_chars(begin, text.data() + text.size(), number).ec;
  int* small = std::holds_alternative<int*>(target_) ? std::get<int*>(target_) : nullptr;
  if (error != std::errc{} || (small && number != static_cast<int>(number)))
    return fmt::format("'{}' is too large", text);
  if (auto wrong = check_range(static_cast<double>(number), text); !wrong.empty()) return wrong;
  if (small) {
    *small = static_cast<int>(number);
  } else {
    *std::get<std::int64_t*>(target_) = number;
  }
  return "";
}

std::string ParamSpec::assign_text(const Config& value) {
  if (value.kind() != Config::Kind::scalar)
    return value.kind() == Config::Kind::null ? "no value is given; a text is wanted (\"\" for an empty one)"
                                              : fmt::format("this is a {}; a text is wanted", kind_name(value.kind()));
  if (type_ == Type::choice) {
    for (std::size_t i = 0; i < choices_.size(); ++i)
      if (choices_[i] == value.text()) {
        if (set_choice_) set_choice_(i);
        if (!set_choice_) *std::get<std::string*>(target_) = value.text();
        return "";
      }
    const auto near = did_you_mean(value.text(), choices_);
    return fmt::format("'{}' is none of {}{}", value.text(), fmt::join(choices_, ", "),
                       near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
  }
  if (auto* path = std::get_if<std::filesystem::path*>(&target_)) {
    **path = value.text();
  } else {
    *std::get<std::string*>(target_) = value.text();
  }
  return "";
}

std::optional<Diagnostic> ParamSpec::assign_vector(const Config& value) {
  if (value.kind() != Config::Kind::sequence || value.items().size() != 3)
    return Diagnostic{value.place(), fmt::format("a list of three numbers is wanted, [x, y, z]{}",
                                                 unit_.empty() ? "" : " in " + unit_)};
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) {
    const Config& item = value.items()[static_cast<std::size_t>(i)];
    if (auto wrong = read_real(item, vector[i]); !wrong.empty()) return Diagnostic{item.place(), wrong};
  }
  *std::get<Eigen::Vector3d*>(target_) = vector;
  return std::nullopt;
}

std::optional<Diagnostic> ParamSpec::assign(const Config& value) {
  std::string wrong;
  switch (type_) {
    case Type::boolean:
      wrong = assign_boolean(value);
      break;
    case Type::integer:
      wrong = assign_integer(value);
      break;
    case Type::real:
      wrong = assign_real(value);
      break;
    case Type::vector3:
      return assign_vector(value);
    case Type::text:
    case Type::path:
    case Type::choice:
      wrong = assign_text(value);
      break;
  }
  if (wrong.empty()) return std::nullopt;
  return Diagnostic{value.place(), wrong};
}

Config ParamSpec::value(const Place& place) const {
  struct Reader {
    const ParamSpec& spec;
    const Place& place;
    Config plain(std::string text) const { return Config::scalar(std::move(text), place); }
    Config operator()(std::monostate) const {
      const auto i = spec.get_choice_();
      PPM_CHECK(i < spec.choices_.size(), "'{}' holds a value that has no name", spec.name_);
      return plain(spec.choices_[i]);
    }
    Config operator()(const bool* v) const { return plain(*v ? "true" : "false"); }
    Config operator()(const int* v) const { return plain(fmt::format("{}", *v)); }
    Config operator()(const std::int64_t* v) const { return plain(fmt::format("{}", *v)); }
    Config operator()(const double* v) const { return plain(number_text(*v)); }
    Config operator()(const float* v) const { return plain(number_text(*v)); }
    Config operator()(const std::string* v) const { return plain(*v); }
    Config operator()(const std::filesystem::path* v) const { return plain(v->string()); }
    Config operator()(const Eigen::Vector3d* v) const {
      return Config::sequence({plain(number_text(v->x())), plain(number_text(v->y())), plain(number_text(v->z()))},
                              place);
    }
  };
  return std::visit(Reader{*this, place}, target_);
}

std::string ParamSpec::value_text() const {
  std::string text = value(Place{}).to_yaml();
  text.pop_back();  // the end of the line
  return text;
}

}  // namespace ppm
