#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "framework/core/error.hpp"

namespace ppm {

/// A tree of values that remembers where each was written. Our own, converted once from YAML, so that yaml-cpp's
/// surprises (duplicate keys, `010`, `yes`) are errors here and nowhere else.
class Config {
 public:
  enum class Kind { null, scalar, sequence, map };
  struct Entry;

  Config() = default;
  static Config scalar(std::string text, Place place, bool quoted = false);
  static Config sequence(std::vector<Config> items, Place place);
  static Config map(Place place);

  Kind kind() const { return kind_; }
  const Place& place() const { return place_; }
  /// Text of a scalar, as written.
  const std::string& text() const { return text_; }
  /// True for a scalar that stood in quotes: always a string.
  bool quoted() const { return quoted_; }
  const std::vector<Config>& items() const { return items_; }
  const std::vector<Entry>& entries() const { return entries_; }
  /// The value at a key of a map, or null.
  const Config* find(const std::string& key) const;
  /// Sets a key of a map (added at the end if it is new). A null value becomes a map.
  void set(const std::string& key, Place key_place, Config value);
  /// The value at a key for changing it, or null.
  Config* find(const std::string& key);
  std::vector<Config>& items() { return items_; }

  /// Block-style YAML text of the tree, for effective configurations: parsing it again gives the same tree. A text that
  /// YAML would read otherwise is put in quotes.
  std::string to_yaml() const;

 private:
  friend class ConfigBuilder;
  Kind kind_ = Kind::null;
  Place place_;
  std::string text_;
  bool quoted_ = false;
  std::vector<Config> items_;
  std::vector<Entry> entries_;
};

struct Config::Entry {
  std::string key;
  Place key_place;
  Config value;
};

const char* kind_name(Config::Kind kind);

/// Parses YAML text; `name` stands for the file in places. Throws one ConfigError with every mistake: syntax (which
/// ends the reading), duplicate keys, keys that are not scalars, anchors, aliases, merges and tags (not supported: a
/// graph is read from top to bottom), tabs as indentation, more than one document.
Config parse_yaml(const std::string& text, const std::string& name);
/// Reads and parses a file. Throws ConfigError where it cannot be read.
Config load_yaml(const std::filesystem::path& file);

/// The candidate most like `word`, the first among equals, or "" where none is. Alike: edit distance (a swap of
/// neighbours counts once; case does not count) of at most a third of the word's length, at least 1.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace ppm
