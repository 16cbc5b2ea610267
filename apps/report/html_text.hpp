#pragma once
#include <string>
#include <string_view>

namespace ppm::report {

/// Text for HTML and SVG, attributes included: & < > " ' become entities.
std::string escaped(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace ppm::report
