#include <cerrno>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include "framework/config/config.hpp"

namespace ppm {

/// Builds a Config from yaml-cpp's events, which still tell what its node tree has lost: quotes, anchors, duplicate
/// keys.
class ConfigBuilder final : public YAML::EventHandler {
 public:
  ConfigBuilder(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  Config take() {
    if (root_.kind_ == Config::Kind::null) root_.place_ = {name_, 1, 1};
    return std::move(root_);
  }
  Diagnostics& mistakes() { return mistakes_; }
  const Place& document_place() const { return document_; }

  void OnDocumentStart(const YAML::Mark& mark) override { document_ = place(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_anchor(mark, anchor);
    Config null;
    null.place_ = place(mark);
    add(std::move(null));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    refuse(mark, "aliases (*name) are not supported: write the value out");
    Config null;
    null.place_ = place(mark);
    add(std::move(null));
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    refuse_open_quote(mark);
    add(Config::scalar(value, place(mark), tag == "!"));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    start(mark, tag, anchor, Config::sequence({}, place(mark)));
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    start(mark, tag, anchor, Config::map(place(mark)));
  }
  void OnMapEnd() override { end(); }

 private:
  struct Key {
    std::string text;
    Place place;
    bool keep;  // false after a mistake: the value is read and dropped
  };
  struct Level {
    Config node;
    std::optional<Key> key;
  };

  Place place(const YAML::Mark& mark) const { return {name_, mark.line + 1, mark.column + 1}; }
  void refuse(const YAML::Mark& mark, std::string why) { mistakes_.push_back({place(mark), std::move(why)}); }
  void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0) refuse(mark, "anchors (&name) are not supported: write the value out");
  }
  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    // yaml-cpp gives "?" to a plain value and "!" to a quoted one
    if (!tag.empty() && tag != "?" && tag != "!") refuse(mark, fmt::format("tags ({}) are not supported", tag));
  }
  // yaml-cpp takes the end of the file for a missing closing quote.
  void refuse_open_quote(const YAML::Mark& mark) {
    auto at = static_cast<std::size_t>(mark.pos);
    const char quote = at < text_.size() ? text_[at] : '\0';
    if (quote != '"' && quote != '\'') return;
    for (++at; at < text_.size(); ++at) {
      const bool pair = quote == '"' ? text_[at] == '\\' : text_.compare(at, 2, "''") == 0;
      if (pair) {
        ++at;
      } else if (text_[at] == quote) {
        return;
      }
    }
    refuse(mark, "this quote is never closed");
  }
  void start(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, Config node) {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    levels_.push_back({std::move(node), std::nullopt});
  }
  void end() {
    Config node = std::move(levels_.back().node);
    levels_.pop_back();
    add(std::move(node));
  }
  void add(Config value) {
    if (levels_.empty()) {
      root_ = std::move(value);
    } else if (levels_.back().node.kind_ == Config::Kind::sequence) {
      levels_.back().node.items_.push_back(std::move(value));
    } else if (!levels_.back().key) {
      levels_.back().key = check_key(levels_.back().node, value);
    } else {
      Key key = std::move(*levels_.back().key);
      levels_.back().key.reset();
      if (value.kind_ == Config::Kind::null)
        value.place_ = key.place;  // the mark of "nothing" is wherever the scanner was
      if (key.keep)
        levels_.back().node.entries_.push_back({std::move(key.text), std::move(key.place), std::move(value)});
    }
  }
  Key check_key(const Config& map, const Config& key) {
    std::string why;
    if (key.kind_ != Config::Kind::scalar) {
      why = fmt::format("a key must be a word, this is a {}", kind_name(key.kind_));
    } else if (key.text_ == "<<" && !key.quoted_) {
      why = "merge keys (<<) are not supported: write the values out";
    } else {
      for (const auto& e : map.entries_)
        if (e.key == key.text_) why = fmt::format("key '{}' is there already, at line {}", e.key, e.key_place.line);
    }
    if (!why.empty()) mistakes_.push_back({key.place_, why});
    return {key.text_, key.place_, why.empty()};
  }

  const std::string& text_;
  const std::string& name_;
  Place document_;
  Config root_;
  std::vector<Level> levels_;
  Diagnostics mistakes_;
};

namespace {

// yaml-cpp takes some tabs for spaces and stops at others with a message that does not name them.
void refuse_tabs(const std::string& text, const std::string& name, Diagnostics& out) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto first = line.find_first_not_of(" \t\r");
    const auto tab = line.find('\t');
    if (first != std::string::npos && line[first] != '#' && tab < first)
      out.push_back({{name, number, static_cast<int>(tab) + 1}, "a tab as indentation: YAML wants spaces"});
  }
}

}  // namespace

Config parse_yaml(const std::string& text, const std::string& name) {
  Diagnostics mistakes;
  refuse_tabs(text, name, mistakes);
  if (!mistakes.empty()) throw ConfigError(std::move(mistakes));

  ConfigBuilder builder(text, name), second(text, name);
  std::optional<Diagnostic> syntax;
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    if (parser.HandleNextDocument(builder) && parser.HandleNextDocument(second))
      syntax = {second.document_place(), "a second document (---) starts here: a file holds one"};
  } catch (const YAML::Exception& e) {
    syntax = {{name, e.mark.line + 1, e.mark.column + 1}, "YAML syntax: " + e.msg};
  }
  mistakes = std::move(builder.mistakes());
  if (syntax) mistakes.push_back(std::move(*syntax));
  if (!mistakes.empty()) throw ConfigError(std::move(mistakes));
  return builder.take();
}

Config load_yaml(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) throw ConfigError(Place{file.string()}, "cannot read: this is a folder");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  if (!in || in.bad())
    throw ConfigError(Place{file.string()}, "cannot read: " + std::generic_category().message(errno ? errno : EIO));
  return parse_yaml(text.str(), file.string());
}

}  // namespace ppm
