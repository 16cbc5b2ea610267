#include "modules/sources/mesh_rays.hpp"

#include <algorithm>
#include <cstring>
#include <embree3/rtcore.h>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

constexpr std::size_t kPacket = 16;

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

void fill(RTCRayHit16& packet, const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> direction) {
  for (std::size_t k = 0; k < kPacket; ++k) {
    const Eigen::Vector3f& d = direction[std::min(k, direction.size() - 1)];
    packet.ray.org_x[k] = origin.x(), packet.ray.org_y[k] = origin.y(), packet.ray.org_z[k] = origin.z();
    packet.ray.dir_x[k] = d.x(), packet.ray.dir_y[k] = d.y(), packet.ray.dir_z[k] = d.z();
    packet.ray.tnear[k] = 0, packet.ray.tfar[k] = std::numeric_limits<float>::infinity();
    packet.ray.time[k] = 0, packet.ray.mask[k] = ~0u, packet.ray.flags[k] = 0;
    packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID, packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
}

MeshHit hit_of(const RTCRayHit16& packet, std::size_t k, const Eigen::Vector3f& direction) {
  if (packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) return {};
  const Eigen::Vector3f n(packet.hit.Ng_x[k], packet.hit.Ng_y[k], packet.hit.Ng_z[k]);
  return {packet.ray.tfar[k], n.normalized() * (n.dot(direction) > 0 ? -1.f : 1.f)};
}

}  // namespace

struct MeshRays::Scene {
  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene;

  void check(const char* what) const {
    const RTCError error = rtcGetDeviceError(device.get());
    if (error != RTC_ERROR_NONE) throw Error(fmt::format("Embree cannot {}: error {}", what, static_cast<int>(error)));
  }
};

MeshRays::MeshRays(const TriangleMesh& mesh) {
  auto made = std::make_unique<Scene>();
  made->device.reset(rtcNewDevice(nullptr));
  made->check("start");
  made->scene.reset(rtcNewScene(made->device.get()));
  RTCGeometry geometry = rtcNewGeometry(made->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  void* position = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                           mesh.position.size());
  void* face = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                                       mesh.face.size());
  if (position && face) {
    std::memcpy(position, mesh.position.data(), mesh.position.size() * 3 * sizeof(float));
    std::memcpy(face, mesh.face.data(), mesh.face.size() * 3 * sizeof(std::uint32_t));
    rtcCommitGeometry(geometry);
    rtcSetSceneFlags(made->scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(made->scene.get(), geometry);
    rtcCommitScene(made->scene.get());
  }
  rtcReleaseGeometry(geometry);
  made->check("build the scene");
  scene_ = std::move(made);
}

MeshRays::~MeshRays() = default;

void MeshRays::cast(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3f> direction,
                    std::span<MeshHit> hit) const {
  PPM_CHECK(direction.size() == hit.size(), "{} rays, room for {} hits", direction.size(), hit.size());
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const Eigen::Vector3f from = origin.cast<float>();
  for (std::size_t i = 0; i < direction.size(); i += kPacket) {
    const std::size_t n = std::min(kPacket, direction.size() - i);
    alignas(64) int valid[kPacket];
    for (std::size_t k = 0; k < kPacket; ++k) valid[k] = k < n ? -1 : 0;
    RTCRayHit16 packet;
    fill(packet, from, direction.subspan(i, n));
    rtcIntersect16(valid, scene_->scene.get(), &context, &packet);
    for (std::size_t k = 0; k < n; ++k) hit[i + k] = hit_of(packet, k, direction[i + k]);
  }
}

}  // namespace ppm
