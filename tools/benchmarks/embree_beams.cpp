// Photon beams in Embree: as geometry of the user's, called for each beam whose box a ray meets, or as Embree's curves,
// whose hits are looked at and refused one by one. Round curves are met twice each, and flat ones, which face the ray,
// once.
#include <fmt/format.h>

#include "benchmarks/room.h"
#include "vpm/surface/embree.h"

namespace vpm::bench {
namespace {

constexpr unsigned kPacket = 16;  // rays

struct Beams {
  const std::vector<PhotonBeam>& list;
  float radius;  // m
};

/// Rays as callbacks meet them, with the axes across each and along it, and what they have found.
template <unsigned N>
struct Asked {
  EmbreeContext context;  // the first member: callbacks get its address
  Vec3 origin;            // of all, m
  float right[3][N], up[3][N], along[3][N], t1[N];
  uint32_t count[N];
  double sum[N];

  explicit Asked(const EyeRay* rays) : origin(rays[0].ray.origin), count{}, sum{} {
    init_context(context);
    for (unsigned i = 0; i < N; ++i) {
      Vec3 s, t;
      make_frame(rays[i].ray.direction, s, t);
      for (int a = 0; a < 3; ++a) {
        right[a][i] = s[a];
        up[a][i] = t[a];
        along[a][i] = rays[i].ray.direction[a];
      }
      t1[i] = rays[i].interval.t1;
    }
  }
  Crossings found() const {
    Crossings all;
    for (unsigned i = 0; i < N; ++i) all += {count[i], sum[i]};
    return all;
  }

  /// Does the beam pass the rays? As PhotonBeamMap finds it.
  void meet(const PhotonBeam& beam, float radius, const int* valid) {
    const Vec3 from = beam.origin - origin, d = beam.direction;
    const float radius2 = radius * radius, inverse = 1.0f / radius2;
    for (unsigned i = 0; i < N; ++i) {
      const auto of = [i](const float(&axis)[3][N], const Vec3& v) {
        return v.x * axis[0][i] + v.y * axis[1][i] + v.z * axis[2][i];
      };
      const float a = of(right, from), b = of(up, from), da = of(right, d), db = of(up, d);
      const float sine2 = da * da + db * db, across = a * db - b * da, s_sine2 = -(a * da + b * db);
      const float t_sine2 = of(along, from) * sine2 + s_sine2 * of(along, d);
      const bool met = valid[i] != 0 && across * across < radius2 * sine2 && s_sine2 >= 0.0f &&
                       s_sine2 < beam.length * sine2 && t_sine2 >= 0.0f && t_sine2 < t1[i] * sine2;
      if (N == 1 && !met) continue;
      const float light = beam.power.g * (1.0f - across * across / sine2 * inverse) / std::sqrt(sine2);
      count[i] += met ? 1 : 0;
      sum[i] += double{met ? light : 0.0f};
    }
  }
};

template <unsigned N>
void meet_beam(const RTCOccludedFunctionNArguments* arguments) {
  const auto& beams = *static_cast<const Beams*>(arguments->geometryUserPtr);
  reinterpret_cast<Asked<N>*>(arguments->context)->meet(beams.list[arguments->primID], beams.radius, arguments->valid);
}

void refuse_curve(const RTCFilterFunctionNArguments* arguments) {
  const auto& beams = *static_cast<const Beams*>(arguments->geometryUserPtr);
  const unsigned beam = RTCHitN_primID(arguments->hit, arguments->N, 0);
  reinterpret_cast<Asked<1>*>(arguments->context)->meet(beams.list[beam], beams.radius, arguments->valid);
  arguments->valid[0] = 0;
}

/// The box around the perpendiculars of a beam, and a hair more for rounding.
void bound_beam(const RTCBoundsFunctionArguments* arguments) {
  const auto& beams = *static_cast<const Beams*>(arguments->geometryUserPtr);
  const PhotonBeam& beam = beams.list[arguments->primID];
  const Vec3 across = beams.radius * glm::sqrt(glm::max(Vec3(0.0f), 1.0f - beam.direction * beam.direction));
  const Vec3 reach = 1.0001f * across + 1e-4f * beams.radius, end = beam.origin + beam.length * beam.direction;
  const Vec3 lo = glm::min(beam.origin, end) - reach, hi = glm::max(beam.origin, end) + reach;
  *arguments->bounds_o = {lo.x, lo.y, lo.z, 0.0f, hi.x, hi.y, hi.z, 0.0f};
}

RTCRay embree_ray(const EyeRay& eye) {
  const auto& [o, d] = eye.ray;
  return {o.x, o.y, o.z, 0.0f, d.x, d.y, d.z, 0.0f, eye.interval.t1, ~0u, 0, 0};
}

class EmbreeBeamIndex final : public BeamIndex {
 public:
  EmbreeBeamIndex(EmbreeBeams kind, const std::vector<PhotonBeam>& beams, float radius, int threads)
      : kind_(kind),
        beams_{beams, radius},
        device_(rtcNewDevice(fmt::format("threads={}", threads).c_str())),
        scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = kind == EmbreeBeams::flat_curves ? curves() : user_geometry();
    rtcSetGeometryUserData(geometry, &beams_);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeBeamIndex() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeBeamIndex(const EmbreeBeamIndex&) = delete;
  EmbreeBeamIndex& operator=(const EmbreeBeamIndex&) = delete;

  Crossings cross(const std::vector<EyeRay>& rays) const override {
    if (kind_ == EmbreeBeams::user_packets)
      return sum_over_rays(rays.size(), kPacket, [&](size_t i) { return packet(&rays[i]); });
    return sum_over_rays(rays.size(), 1, [&](size_t i) { return single(rays[i]); });
  }

 private:
  RTCGeometry user_geometry() const {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(beams_.list.size()));
    rtcSetGeometryBoundsFunction(geometry, bound_beam, nullptr);
    rtcSetGeometryOccludedFunction(geometry, kind_ == EmbreeBeams::user_packets ? meet_beam<kPacket> : meet_beam<1>);
    return geometry;
  }
  RTCGeometry curves() const {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_FLAT_LINEAR_CURVE);
    const size_t count = beams_.list.size();
    auto* ends = static_cast<glm::vec4*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(glm::vec4), 2 * count));
    auto* first = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), count));
    for (size_t i = 0; i < count; ++i) {
      const PhotonBeam& beam = beams_.list[i];
      ends[2 * i] = glm::vec4(beam.origin, beams_.radius);
      ends[2 * i + 1] = glm::vec4(beam.origin + beam.length * beam.direction, beams_.radius);
      first[i] = static_cast<unsigned>(2 * i);
    }
    rtcSetGeometryOccludedFilterFunction(geometry, refuse_curve);
    return geometry;
  }

  Crossings single(const EyeRay& eye) const {
    Asked<1> asked(&eye);
    RTCRay ray = embree_ray(eye);
    embree_occluded(scene_, asked.context, ray);
    return asked.found();
  }
  Crossings packet(const EyeRay* eyes) const {
    Asked<kPacket> asked(eyes);
    RTCRay16 rays;
    alignas(64) int valid[kPacket];
    for (unsigned i = 0; i < kPacket; ++i) {
      valid[i] = -1;
      rays.org_x[i] = eyes[i].ray.origin.x;
      rays.org_y[i] = eyes[i].ray.origin.y;
      rays.org_z[i] = eyes[i].ray.origin.z;
      rays.dir_x[i] = eyes[i].ray.direction.x;
      rays.dir_y[i] = eyes[i].ray.direction.y;
      rays.dir_z[i] = eyes[i].ray.direction.z;
      rays.tnear[i] = rays.time[i] = 0.0f;
      rays.tfar[i] = eyes[i].interval.t1;
      rays.mask[i] = ~0u;
      rays.id[i] = rays.flags[i] = 0;
    }
    embree_occluded(scene_, asked.context, valid, rays);
    return asked.found();
  }

  EmbreeBeams kind_;
  Beams beams_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace

std::unique_ptr<BeamIndex> make_embree_beams(EmbreeBeams kind, const std::vector<PhotonBeam>& beams, float radius,
                                             int threads) {
  return std::make_unique<EmbreeBeamIndex>(kind, beams, radius, threads);
}

}  // namespace vpm::bench
