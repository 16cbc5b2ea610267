#pragma once
#include <Eigen/Core>

#include "framework/graph/abi_headers.hpp"  // generated: PPM_VERSION, PPM_HEADERS_HASH

/// What must agree between the framework and a plug-in for their types to be the same bytes, as text. It is made where
/// this header is compiled: in the framework's library and in the plug-in, which then are compared. Not part of it:
/// optimisation and NDEBUG, on which no public type depends.
#define PPM_TEXT_OF_(x) #x
#define PPM_TEXT_OF(x) PPM_TEXT_OF_(x)

#if defined(__SANITIZE_ADDRESS__)
#define PPM_ABI_SANITIZER "address"
#elif defined(__SANITIZE_THREAD__)
#define PPM_ABI_SANITIZER "thread"
#else
#define PPM_ABI_SANITIZER "none"
#endif

#ifdef _GLIBCXX_DEBUG
#define PPM_ABI_CONTAINERS "debug"
#else
#define PPM_ABI_CONTAINERS "release"
#endif

#define PPM_ABI_STAMP                                                     \
  "ppm " PPM_VERSION ", headers " PPM_HEADERS_HASH                        \
  ", C++ ABI " PPM_TEXT_OF(__GXX_ABI_VERSION) ", libstdc++ " PPM_TEXT_OF( \
      _GLIBCXX_USE_CXX11_ABI) ", containers " PPM_ABI_CONTAINERS          \
                              ", Eigen alignment " PPM_TEXT_OF(EIGEN_MAX_ALIGN_BYTES) ", sanitizer " PPM_ABI_SANITIZER
