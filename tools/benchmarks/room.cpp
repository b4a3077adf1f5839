// A room full of fog as a pass of photon beams sees it.
#include "benchmarks/room.h"

#include <cmath>

#include "vpm/photon/trace.h"
#include "vpm/scene/assemble.h"

namespace vpm::bench {
namespace {

constexpr int kPixels = 512;  // along each side of the picture, a power of 2

/// Every other bit of a number, from the lowest on, put side by side.
int every_other_bit(uint32_t number) {
  uint32_t bits = 0;
  for (int i = 0; i < 16; ++i) bits |= (number >> (2 * i) & 1u) << i;
  return static_cast<int>(bits);
}

}  // namespace

Scene foggy_room(float sigma_t) {
  SceneParts parts;
  Medium fog;
  fog.sigma_t = Rgb(sigma_t);
  fog.sigma_s = 0.9f * fog.sigma_t;
  parts.media = {{fog}};
  parts.materials = {{Lambertian{Rgb(0.5f)}}, {Lambertian{Rgb(0.0f)}}};
  ShapePart lamp{.surface = quad_mesh({-0.25, 1.98, -0.25}, {0.5, 0.0, 0.0}, {0.0, 0.0, 0.5}), .material = 1};
  lamp.emission = Rgb(10.0f);
  parts.shapes = {{.surface = box_mesh({-1.0, 0.0, -1.0}, {1.0, 2.0, 1.0}), .media = Interface{.inside = 0}}, lamp};
  parts.camera = make_camera({0.0f, 1.0f, 0.95f}, {0.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, 75.0f, {kPixels, kPixels});
  return assemble(std::move(parts)).scene;
}

std::vector<PhotonBeam> room_beams(const Scene& scene, size_t count) {
  BeamRecorder recorder(scene, any_photon, {});
  TraceSettings settings;
  settings.emitted = count;  // each photon flies once at the least
  Progress silent("photons", 0, false);
  trace_photons(scene, *make_distance_strategy({}), settings, {&recorder}, silent);
  std::vector<PhotonBeam> beams = std::move(recorder.beams[0]);
  beams.resize(count);
  return beams;
}

std::vector<EyeRay> room_rays(const Scene& scene) {
  std::vector<EyeRay> rays;
  for (uint32_t i = 0; i < kPixels * kPixels; ++i) {
    const Ray ray = scene.camera.ray(0.5f + Vec2(every_other_bit(i), every_other_bit(i >> 1)));
    rays.push_back({ray, {0.0f, scene.geometry.intersect(ray)->t}});
  }
  return rays;
}

std::vector<PhotonBeam> cut_beams(const std::vector<PhotonBeam>& beams, double longest) {
  std::vector<PhotonBeam> pieces;
  for (const PhotonBeam& beam : beams) {
    const double count = std::max(1.0, std::ceil(double{beam.length} / longest)), length = double{beam.length} / count;
    for (double i = 0.0; i < count; ++i)
      pieces.push_back({Vec3(Vec3d(beam.origin) + i * length * Vec3d(beam.direction)), static_cast<float>(length),
                        beam.direction, beam.power});
  }
  return pieces;
}

}  // namespace vpm::bench
