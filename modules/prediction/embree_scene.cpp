#include "modules/prediction/embree_scene.hpp"

#include <algorithm>
#include <cstring>
#include <embree3/rtcore.h>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

RTCBuildQuality quality(EmbreeOptions::Build build) {
  if (build == EmbreeOptions::Build::low) return RTC_BUILD_QUALITY_LOW;
  return build == EmbreeOptions::Build::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
}

// Rays bring their own filter of hits, see trace_hits().
RTCSceneFlags scene_flags(const EmbreeOptions& options) {
  const int robust = options.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE;
  return static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION | robust);
}

const char* reason(RTCError error) {
  switch (error) {
    case RTC_ERROR_OUT_OF_MEMORY:
      return "out of memory";
    case RTC_ERROR_UNSUPPORTED_CPU:
      return "this processor lacks SSE2";
    case RTC_ERROR_INVALID_ARGUMENT:
      return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION:
      return "invalid operation";
    default:
      return "unknown error";
  }
}

}  // namespace

EmbreeDevice::EmbreeDevice(EmbreeOptions options) : options_(options), device_(rtcNewDevice(nullptr)) {
  if (!device_) throw Error(fmt::format("Embree cannot start: {}", reason(rtcGetDeviceError(nullptr))));
  auto count = [](void* total, ssize_t bytes, bool) {
    static_cast<std::atomic<std::int64_t>*>(total)->fetch_add(bytes, std::memory_order_relaxed);
    return true;
  };
  rtcSetDeviceMemoryMonitorFunction(device_, count, &bytes_);
}

EmbreeDevice::~EmbreeDevice() {
  rtcReleaseDevice(device_);
}

void EmbreeDevice::check() const {
  const RTCError error = rtcGetDeviceError(device_);
  if (error != RTC_ERROR_NONE) throw Error(fmt::format("Embree: {}", reason(error)));
}

EmbreeScene::EmbreeScene(const EmbreeDevice& device, const Geometry& geometry) {
  PPM_CHECK(!geometry.face.empty(), "a chunk without faces has no scene");
  const EmbreeOptions& options = device.options();
  RTCGeometry mesh = rtcNewGeometry(device.handle(), RTC_GEOMETRY_TYPE_TRIANGLE);
  void* position = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                           geometry.position.size());
  void* face = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                                       geometry.face.size());
  if (position && face) {
    std::memcpy(position, geometry.position.data(), geometry.position.size() * 3 * sizeof(float));
    std::memcpy(face, geometry.face.data(), geometry.face.size() * 3 * sizeof(std::uint32_t));
    rtcSetGeometryBuildQuality(mesh, quality(options.build));
    rtcCommitGeometry(mesh);
    scene_.reset(rtcNewScene(device.handle()));
    rtcSetSceneFlags(handle(), scene_flags(options));
    rtcSetSceneBuildQuality(handle(), quality(options.build));
    rtcAttachGeometry(handle(), mesh);
    rtcJoinCommitScene(handle());
  }
  rtcReleaseGeometry(mesh);
  device.check();
}

void EmbreeScene::Release::operator()(RTCSceneTy* scene) const {
  rtcReleaseScene(scene);
}

}  // namespace ppm
