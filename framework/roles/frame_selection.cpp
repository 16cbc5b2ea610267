#include "framework/roles/frame_selection.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string_view>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

std::string_view ordinal_ending(std::int64_t n) {
  if (n % 100 >= 11 && n % 100 <= 13) return "th";
  switch (n % 10) {
    case 1:
      return "st";
    case 2:
      return "nd";
    case 3:
      return "rd";
    default:
      return "th";
  }
}

}  // namespace

std::vector<std::int64_t> FrameSelection::followed() const {
  std::vector<std::int64_t> all;
  std::ranges::merge(mapped, std::ranges::subrange(std::ranges::upper_bound(held_out, mapped.front()), held_out.end()),
                     std::back_inserter(all));
  return all;
}

std::int64_t parse_holdout(const std::string& text) {
  if (text == "none") return 0;
  constexpr std::string_view prefix = "every ";
  if (!text.starts_with(prefix)) return -1;
  std::int64_t n = 0;
  const auto [stop, error] = std::from_chars(text.data() + prefix.size(), text.data() + text.size(), n);
  const auto ending = std::string_view(text).substr(static_cast<std::size_t>(stop - text.data()));
  return error == std::errc() && n >= 2 && ending == ordinal_ending(n) ? n : -1;
}

FrameSelection select_frames(const std::string& name, std::int64_t images, std::int64_t first, std::int64_t last,
                             std::int64_t stride, std::int64_t holdout_every) {
  if (images == 0) throw DataError(name, "holds no image");
  if (first >= images) throw DataError(name, fmt::format("'first' is {}, but the last image is {}", first, images - 1));
  if (last >= images) throw DataError(name, fmt::format("'last' is {}, but the last image is {}", last, images - 1));
  if (last == -1) last = images - 1;
  if (last < first)
    throw DataError(name, fmt::format("'last' ({}) is before 'first' ({}): no image is selected", last, first));
  auto is_held_out = [=](std::int64_t i) { return holdout_every > 0 && i % holdout_every == holdout_every / 2; };
  FrameSelection out;
  for (auto i = first; i <= last; ++i)
    if (is_held_out(i)) out.held_out.push_back(i);
  for (auto i = first; i <= last; i += stride)
    if (!is_held_out(i)) out.mapped.push_back(i);
  if (out.mapped.empty())
    throw DataError(name, fmt::format("every image from {} to {} in steps of {} is held out: none is left to map",
                                      first, last, stride));
  return out;
}

}  // namespace ppm
