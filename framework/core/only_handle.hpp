#pragma once
#include <memory>

namespace ppm {

/// True where nobody else can get at the value any more, so that its memory may be written again. use_count() alone does
/// not order us after what other threads read before they dropped their handles; taking a second handle does, because it
/// changes the count as they did.
template <class T>
bool is_only_handle(const std::shared_ptr<T>& handle) {
  const auto second = handle;
  return handle.use_count() == 2;
}

}  // namespace ppm
