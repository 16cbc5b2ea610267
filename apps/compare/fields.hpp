#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "framework/config/params.hpp"

namespace ppm {

/// Reads the keys of one map of a suite file: those of `plain` through their declarations; `other` are known and left to the
/// caller. Appends every mistake; an unknown key is one.
void read_fields(const Config& map, const std::string& owner, Params& plain, const std::vector<std::string>& other,
                 Diagnostics& mistakes);

/// The value of a key where it is of that kind; null where the key is absent, or after a report.
const Config* field(const Config& map, const std::string& key, Config::Kind kind, Diagnostics& mistakes);

/// True for a map; else reports: "a graph is a map such as {name: x, graph: FILE}, not a list".
bool is_map(const Config& value, const std::string& what, const std::string& example, Diagnostics& mistakes);

/// The words of a list; reports what is none.
std::vector<std::pair<std::string, Place>> read_words(const Config& list, const std::string& what, Diagnostics& mistakes);

/// A path that is written in a file: a relative one starts at the file's folder.
std::filesystem::path path_beside(const Place& place, const std::filesystem::path& written);

/// Reports a name that cannot be a folder's: letters, digits, '_', '-' and '.', not '-' or '.' first.
void check_name(const std::string& name, const Place& place, const std::string& what, Diagnostics& mistakes);

}  // namespace ppm
