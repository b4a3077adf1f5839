// Scattering by a guide that is far from what media and surfaces do by themselves: what goes on is still what they
// send on, and where they send it.
#include <cassert>

#include "vpm/medium/make_grid.h"
#include "vpm/photon/guided_scatter.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/directions.h"
#include "vpm/study/validate/groups.h"

namespace vpm {

namespace {

constexpr size_t kGuideRings = 6, kGuideCells = kGuideRings * kSectors;
const Vec3 kUp(0.0f, 0.0f, 1.0f);

/// One cube that knows of some light along all directions and of much along a few.
DirectionGuide lopsided() {
  DirectionGuide guide({Vec3(-1.0f), Vec3(1.0f)}, 1);
  for (size_t cell = 0; cell < DirectionCells::kCount; ++cell)
    guide.add_track({Vec3(0.0f), -DirectionCells::sample(cell, Vec2(0.5f))}, 1.0f, cell % 29 == 3 ? 100.0f : 1.0f);
  guide.finish();
  return guide;
}

/// An isotropic medium fills cells of equal solid angle evenly; a forward scattering one keeps its mean cosine.
std::vector<Check> check_media(const DirectionGuide& guide, const Effort& effort) {
  constexpr float kAlbedo = 0.7f, kG = 0.6f;
  const Vec3 travel = glm::normalize(Vec3(0.2f, -0.3f, 0.9f));
  const Medium isotropic = make_medium(nullptr, Rgb(1.0f), kAlbedo);
  Medium haze = isotropic;
  haze.phase = HenyeyGreenstein{kG};
  const auto scattered = [&](const Medium& fog, Rng& rng) {
    PathState state{{Vec3(0.1f), travel}, 0, Rgb(1.0f)};
    if (!scatter_in_medium(guide, fog, state, rng)) state.throughput = Rgb(0.0f);
    return state;
  };
  const uint64_t count = effort.count(100'000, 4'000'000);
  const auto even = sample_moments(kGuideCells, count, effort.seed_of("guided, isotropic"), [&](Rng& rng, double* out) {
    const PathState state = scattered(isotropic, rng);
    const Vec3& d = state.ray.direction;
    out[cell_of(0.5 * away_from(kUp, d), kGuideRings) * kSectors + sector_about(kUp, d)] = state.throughput.g;
  });
  const auto forward = sample_moments(2, count, effort.seed_of("guided, forward"), [&](Rng& rng, double* out) {
    const PathState state = scattered(haze, rng);
    out[0] = state.throughput.g;
    out[1] = state.throughput.g * (1.0 - away_from(travel, state.ray.direction));
  });
  return {check_weights("isotropic medium, power by direction", even,
                        std::vector<double>(kGuideCells, kAlbedo / static_cast<double>(kGuideCells))),
          check_mean("Henyey-Greenstein, g = 0.6, power", forward[0], double{kAlbedo}),
          check_mean("Henyey-Greenstein, g = 0.6, power times cosine", forward[1], double{kAlbedo} * double{kG})};
}

/// A level sheet of that material.
Scene sheet(const Material& material) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1, -1, 0), Vec3d(2, 0, 0), Vec3d(0, 2, 0)), material);
  scene.geometry.commit();
  return scene;
}

/// A path that comes down on the sheet, scattered there.
class Landing {
 public:
  explicit Landing(const Material& material) : scene_(sheet(material)) {
    met_ = scene_.geometry.encounter(ray_, kInfinity);
    assert(met_);
  }
  /// By `guide`, or by the surface alone where there is none. Its power is 0 where it was absorbed.
  PathState scattered(const DirectionGuide* guide, Rng& rng, Scatter& scatter) const {
    PathState state{ray_, kVacuum, Rgb(1.0f)};
    const bool alive = guide ? scatter_at_surface(*guide, scene_, met_.hits[0], state, rng, scatter)
                             : scatter_at_surface(scene_, met_.hits[0], state, rng, scatter);
    if (!alive) state.throughput = Rgb(0.0f);
    return state;
  }

 private:
  Scene scene_;
  const Ray ray_{Vec3(0.2f, -0.1f, 1.0f), glm::normalize(Vec3(-0.4f, 0.3f, -1.0f))};
  Encounter met_;
};

/// A diffuse sheet fills cells of equal flux evenly; what metal sends on and absorbs, by directions that absorb unlike
/// shares, is what came; rough glass sends to either side what it does without a guide.
std::vector<Check> check_surfaces(const DirectionGuide& guide, const Effort& effort) {
  constexpr float kReflectance = 0.7f;
  const Landing diffuse(Lambertian{Rgb(kReflectance)}), glass(RoughDielectric{1.5f, 0.4f});
  const Landing metal(RoughConductor{Rgb(0.4f), Rgb(2.5f), 0.6f});
  const uint64_t count = effort.count(100'000, 4'000'000);
  const auto above = sample_moments(kGuideCells, count, effort.seed_of("guided, diffuse"), [&](Rng& rng, double* out) {
    Scatter scatter;
    const PathState state = diffuse.scattered(&guide, rng, scatter);
    const Vec3& d = state.ray.direction;
    const double cosine = 1.0 - away_from(kUp, d);
    if (cosine > 0.0) out[cell_of(cosine * cosine, kGuideRings) * kSectors + sector_about(kUp, d)] = state.throughput.g;
  });
  const auto balance = sample_moments(1, count, effort.seed_of("guided, metal"), [&](Rng& rng, double* out) {
    Scatter scatter;
    out[0] = metal.scattered(&guide, rng, scatter).throughput.g;
    out[0] += 1.0 - scatter.weight.g;
  });
  const auto by_side = [&](const DirectionGuide* by, const char* name) {
    return sample_moments(2, count, effort.seed_of(name), [&](Rng& rng, double* out) {
      Scatter scatter;
      const PathState state = glass.scattered(by, rng, scatter);
      out[state.ray.direction.z > 0.0f ? 0 : 1] = state.throughput.g;
    });
  };
  const auto guided = by_side(&guide, "guided, glass"), plain = by_side(nullptr, "not guided, glass");
  return {check_weights("diffuse sheet, power by direction", above,
                        std::vector<double>(kGuideCells, kReflectance / static_cast<double>(kGuideCells))),
          check_mean("rough metal, power that goes on and is absorbed", balance[0], 1.0),
          check_same("rough glass, reflected power", guided[0], plain[0]),
          check_same("rough glass, transmitted power", guided[1], plain[1])};
}

}  // namespace

std::vector<Experiment> guide_experiments() {
  return {{0, "directions drawn by a guide", [](const Effort& effort) {
             const DirectionGuide guide = lopsided();
             std::vector<Check> checks = check_media(guide, effort);
             append(checks, check_surfaces(guide, effort));
             return checks;
           }}};
}

}  // namespace vpm
