#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace ppm::report {

/// Text for HTML and SVG, attributes included: & < > " ' become entities.
std::string escaped(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// <img> with the PNG inside, or "" where the file is absent.
std::string embedded_png(const std::filesystem::path& file, const std::string& alt);

}  // namespace ppm::report
