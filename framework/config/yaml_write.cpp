#include <string_view>

#include "framework/config/config.hpp"

namespace ppm {

namespace {

bool is_null_word(std::string_view s) {
  return s == "~" || s == "null" || s == "Null" || s == "NULL";
}

/// True where YAML reads `s` as itself without quotes. flow: inside [ ].
bool plain_is_safe(std::string_view s, bool flow) {
  if (s.empty() || is_null_word(s) || s == "<<" || s.substr(0, 3) == "---" || s.substr(0, 3) == "...") return false;
  if (s.front() == ' ' || s.back() == ' ' || s.back() == ':') return false;
  if (std::string_view("?:,[]{}#&*!|>'\"%@`").find(s.front()) != s.npos) return false;
  if (s.front() == '-' && (s.size() == 1 || s[1] == ' ')) return false;
  if (s.find(": ") != s.npos || s.find(" #") != s.npos) return false;
  if (flow && s.find_first_of(",[]{}:?") != s.npos) return false;
  for (unsigned char c : s)
    if (c < 0x20 || c == 0x7f) return false;
  return true;
}

std::string in_quotes(std::string_view s) {
  std::string out = "\"";
  for (char c : s) {
    const auto u = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      (out += '\\') += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (u < 0x20 || u == 0x7f) {
      out += fmt::format("\\x{:02x}", u);
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string scalar_text(const Config& c, bool flow) {
  if (c.kind() == Config::Kind::null) return "null";
  return !c.quoted() && plain_is_safe(c.text(), flow) ? c.text() : in_quotes(c.text());
}

bool is_leaf(const Config& c) {
  return c.kind() == Config::Kind::null || c.kind() == Config::Kind::scalar;
}

/// True for what is written on the line of its key: a value, a list of values, an empty list or map.
bool fits_line(const Config& c) {
  if (c.kind() == Config::Kind::map) return c.entries().empty();
  for (const auto& item : c.items())
    if (!is_leaf(item)) return false;
  return true;
}

std::string line_text(const Config& c) {
  if (c.kind() == Config::Kind::map) return "{}";
  if (is_leaf(c)) return scalar_text(c, false);
  std::string out = "[";
  for (const auto& item : c.items()) out += (out.size() > 1 ? ", " : "") + scalar_text(item, true);
  return out + "]";
}

/// Writes a map or list as a block. The first line has been indented by the caller.
void write_block(const Config& c, std::size_t indent, std::string& out) {
  const std::string pad(indent, ' ');
  bool first = true;
  auto start_line = [&] {
    if (!first) out += pad;
    first = false;
  };
  for (const auto& item : c.items()) {
    start_line();
    out += "- ";
    if (fits_line(item)) {
      out += line_text(item) + "\n";
    } else {
      write_block(item, indent + 2, out);
    }
  }
  for (const auto& e : c.entries()) {
    start_line();
    out += (plain_is_safe(e.key, true) ? e.key : in_quotes(e.key)) + ":";
    if (fits_line(e.value)) {
      out += " " + line_text(e.value) + "\n";
    } else {
      out += "\n" + std::string(indent + 2, ' ');
      write_block(e.value, indent + 2, out);
    }
  }
}

}  // namespace

std::string Config::to_yaml() const {
  if (fits_line(*this)) return line_text(*this) + "\n";
  std::string out;
  write_block(*this, 0, out);
  return out;
}

}  // namespace ppm
