#pragma once
#include <atomic>
#include <compare>
#include <cstdint>
#include <memory>

#include "modules/maps/ppm/chunk.hpp"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace ppm {

/// How chunk scenes are built. Fixed for the life of a device.
struct EmbreeOptions {
  bool robust = true;           ///< watertight ray-triangle test: no ray slips between two faces that share an edge
  enum class Build { low, medium, high } build = Build::medium;
  auto operator<=>(const EmbreeOptions&) const = default;
};

/// An Embree device, and the memory that its scenes occupy.
class EmbreeDevice {
 public:
  /// Throws Error where Embree cannot start.
  explicit EmbreeDevice(EmbreeOptions options);
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;
  ~EmbreeDevice();

  RTCDeviceTy* handle() const { return device_; }
  const EmbreeOptions& options() const { return options_; }
  std::int64_t bytes() const { return bytes_; }
  /// Throws Error with Embree's reason if a call on this thread failed.
  void check() const;

 private:
  EmbreeOptions options_;
  std::atomic<std::int64_t> bytes_{0};
  RTCDeviceTy* device_ = nullptr;
};

/// The acceleration structure of one chunk's Geometry. Holds a copy of the triangles: it needs the Geometry only while
/// it is built.
class EmbreeScene {
 public:
  /// Builds in the calling thread; several may be built at the same time. The geometry must have a face.
  EmbreeScene(const EmbreeDevice& device, const Geometry& geometry);
  RTCSceneTy* handle() const { return scene_.get(); }

 private:
  struct Release {
    void operator()(RTCSceneTy* scene) const;
  };
  std::unique_ptr<RTCSceneTy, Release> scene_;
};

}  // namespace ppm
