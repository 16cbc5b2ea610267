// Faces as the gather form of the texel update needs them: for a file that is compiled once for each target.
#include <cstddef>
#include <cstdint>
#include <hwy/highway.h>

#include "modules/maps/ppm/texel_gather.hpp"

#if defined(PPM_FACE_IN_VIEW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PPM_FACE_IN_VIEW_INL
#undef PPM_FACE_IN_VIEW_INL
#else
#define PPM_FACE_IN_VIEW_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace ppm::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
struct Vec3 {
  hn::Vec<D> x, y, z;
};

template <class V>
HWY_INLINE V dot(V ax, V ay, V az, V bx, V by, V bz) {
  return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}

/// A face in the camera frame, as its texels need it.
struct FaceInView {
  float corner[3];             // m, the first
  float step_i[3], step_j[3];  // m, from texel to texel
  /// The distance of a measured point from the face's plane: depth * (x * slope_x + y * slope_y + slope) - offset.
  float slope_x, slope_y, slope, offset;
  float inverse_offset;  // 1/m, positive where the face is seen from its observed side
  float inverse_area;    // 1/m^2, of what one texel stands for
  float excess;          // m^2
};

/// As many faces as a vector has lanes are set up at once.
template <class D>
class FaceSetup {
 public:
  using V = hn::Vec<D>;
  using DI = hn::RebindToSigned<D>;

  HWY_INLINE FaceSetup(const GatherImage& image, const GatherFaces& of) : image_(image), of_(of) {}

  /// faces: of the lanes. divisions: theirs.
  HWY_INLINE void run(D d, hn::Vec<DI> faces, V divisions, FaceInView* out) {
    const DI di;
    const auto first = hn::Mul(faces, hn::Set(di, 3));
    const Vec3<D> a = corner(d, first), b = corner(d, hn::Add(first, hn::Set(di, 1))),
                  c = corner(d, hn::Add(first, hn::Set(di, 2)));
    const Vec3<D> e1{hn::Sub(b.x, a.x), hn::Sub(b.y, a.y), hn::Sub(b.z, a.z)};
    const Vec3<D> e2{hn::Sub(c.x, a.x), hn::Sub(c.y, a.y), hn::Sub(c.z, a.z)};
    const Vec3<D> cross{hn::Sub(hn::Mul(e1.y, e2.z), hn::Mul(e1.z, e2.y)),
                        hn::Sub(hn::Mul(e1.z, e2.x), hn::Mul(e1.x, e2.z)),
                        hn::Sub(hn::Mul(e1.x, e2.y), hn::Mul(e1.y, e2.x))};
    const V twice_area = hn::Sqrt(dot(cross.x, cross.y, cross.z, cross.x, cross.y, cross.z));
    const V nx = hn::Div(cross.x, twice_area), ny = hn::Div(cross.y, twice_area), nz = hn::Div(cross.z, twice_area);
    const V slope_x = hn::Mul(nx, hn::Set(d, image_.inv_fx)), slope_y = hn::Mul(ny, hn::Set(d, image_.inv_fy));
    const V slope =
        hn::Sub(nz, hn::Add(hn::Mul(slope_x, hn::Set(d, image_.cx)), hn::Mul(slope_y, hn::Set(d, image_.cy))));
    put(d, a, out, &FaceInView::corner);
    put(d, {hn::Div(e1.x, divisions), hn::Div(e1.y, divisions), hn::Div(e1.z, divisions)}, out, &FaceInView::step_i);
    put(d, {hn::Div(e2.x, divisions), hn::Div(e2.y, divisions), hn::Div(e2.z, divisions)}, out, &FaceInView::step_j);
    put(d, slope_x, out, &FaceInView::slope_x);
    put(d, slope_y, out, &FaceInView::slope_y);
    put(d, slope, out, &FaceInView::slope);
    const V offset = dot(nx, ny, nz, a.x, a.y, a.z);
    put(d, offset, out, &FaceInView::offset);
    put(d, hn::Div(hn::Set(d, -1.0f), offset), out, &FaceInView::inverse_offset);
    put(d, hn::Div(hn::Mul(divisions, divisions), twice_area), out, &FaceInView::inverse_area);
  }

 private:
  /// The corner of that number in of.corner, in the camera frame.
  HWY_INLINE Vec3<D> corner(D d, hn::Vec<DI> number) const {
    const DI di;
    const auto vertex = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(of_.corner), number);
    const auto at = hn::Mul(vertex, hn::Set(di, 3));
    const auto from_centre = [&](int k) HWY_ATTR {
      const V p = hn::GatherIndex(d, of_.position + k, at);
      return hn::Sub(hn::Sub(p, hn::Set(d, image_.centre[k])), hn::Set(d, image_.centre_rest[k]));
    };
    const V x = from_centre(0), y = from_centre(1), z = from_centre(2);
    const auto on_axis = [&](const float* axis) HWY_ATTR {
      return dot(hn::Set(d, axis[0]), hn::Set(d, axis[1]), hn::Set(d, axis[2]), x, y, z);
    };
    return {on_axis(image_.axes), on_axis(image_.axes + 3), on_axis(image_.axes + 6)};
  }
  /// Each lane to its face.
  HWY_INLINE void put(D d, V values, FaceInView* out, float FaceInView::*member) const {
    HWY_ALIGN float lane[hn::MaxLanes(D())];
    hn::Store(values, d, lane);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k) out[k].*member = lane[k];
  }
  HWY_INLINE void put(D d, const Vec3<D>& values, FaceInView* out, float (FaceInView::*member)[3]) const {
    HWY_ALIGN float x[hn::MaxLanes(D())], y[hn::MaxLanes(D())], z[hn::MaxLanes(D())];
    hn::Store(values.x, d, x);
    hn::Store(values.y, d, y);
    hn::Store(values.z, d, z);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k) {
      (out[k].*member)[0] = x[k];
      (out[k].*member)[1] = y[k];
      (out[k].*member)[2] = z[k];
    }
  }

  const GatherImage& image_;
  const GatherFaces& of_;
};

}  // namespace ppm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
