#include "framework/config/config.hpp"

namespace ppm {

Config Config::scalar(std::string text, Place place, bool quoted) {
  Config c;
  c.kind_ = Kind::scalar;
  c.text_ = std::move(text);
  c.place_ = std::move(place);
  c.quoted_ = quoted;
  return c;
}

Config Config::sequence(std::vector<Config> items, Place place) {
  Config c;
  c.kind_ = Kind::sequence;
  c.items_ = std::move(items);
  c.place_ = std::move(place);
  return c;
}

Config Config::map(Place place) {
  Config c;
  c.kind_ = Kind::map;
  c.place_ = std::move(place);
  return c;
}

Config* Config::find(const std::string& key) {
  for (auto& e : entries_)
    if (e.key == key) return &e.value;
  return nullptr;
}

const Config* Config::find(const std::string& key) const {
  return const_cast<Config*>(this)->find(key);
}

void Config::set(const std::string& key, Place key_place, Config value) {
  if (kind_ == Kind::null) kind_ = Kind::map;
  PPM_CHECK(kind_ == Kind::map, "cannot set '{}' in a {}", key, kind_name(kind_));
  if (Config* old = find(key)) {
    *old = std::move(value);
  } else {
    entries_.push_back({key, std::move(key_place), std::move(value)});
  }
}

const char* kind_name(Config::Kind kind) {
  switch (kind) {
    case Config::Kind::null:
      return "nothing";
    case Config::Kind::scalar:
      return "single value";
    case Config::Kind::sequence:
      return "list";
    case Config::Kind::map:
      break;
  }
  return "map";
}

}  // namespace ppm
