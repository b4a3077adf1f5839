// Photon beams at their ends, along rays and around points: the narrowest peaks, media from next to nothing to opaque,
// beams a thousand kilometres long, and beams that run nearly or exactly along the ray.
#include "hard/hard_scenes.h"
#include "vpm/study/estimates/airlight.h"
#include "vpm/study/estimates/slab_radiance.h"
#include "vpm/study/exact/airlight.h"
#include "vpm/study/exact/slab.h"

namespace vpm {
namespace {

constexpr std::string_view kOfBeams[] = {"photon-beams", "beams-points"};

/// Student's test of the mean over passes. It says something: the standard error is at most a tenth of the exact value.
void expect_radiance(const Moments& found, double exact, Worst& worst, const std::string& what) {
  const Check check = check_mean(what, found, exact);
  EXPECT_GE(check.p, kFalseAlarms) << what << ": " << check.value << " +- " << check.error << ", exact " << exact;
  EXPECT_LT(check.error, 0.1 * exact) << what;
  worst.see(check.value / exact - 1.0);
}

double exact_radiance(const BeamAirlight& a) {
  return exact::solve_beam_airlight({a.sigma_t, a.albedo, a.g, a.beam_radius, a.cosine, a.flown, a.seen}).value;
}

TEST(BeamsExtremes, TheNarrowestPeakIsSeenExactly) {
  // From ahead the eye looks into the peak, 0.01 rad beside its middle: 1e5 times as bright as from behind.
  Worst worst("relative error of photon beams, g = +-0.999");
  for (const std::string_view type : kOfBeams)
    for (const double g : {0.999, -0.999})
      for (const double sine : {0.01, 0.1, 1.0}) {
        const double cosine = -std::copysign(std::sqrt(1.0 - sine * sine), g), half = 0.5 / sine;
        const BeamAirlight seen{0.2 / half, 1.0, g, 0.5, cosine, 2.0 + half, 2.0 + half};
        const PhotonRays by{.type = type, .radius = 0.2, .photons = 200, .passes = 20, .seed = 1};
        expect_radiance(estimate_beam_airlight_by_photons(seen, by).unbiased, exact_radiance(seen), worst,
                        "g " + std::to_string(g) + ", sine " + std::to_string(sine));
      }
}

TEST(BeamsExtremes, BeamsNearlyAlongTheRayAreWeighedBySineAlone) {
  Worst worst("relative error of photon beams, sines of 1e-2 to 1e-4");
  for (const double sine : {1e-2, 1e-3, 1e-4})
    for (const double side : {-1.0, 1.0}) {
      const double half = 0.01 / sine;
      const BeamAirlight seen{0.5 / half, 0.5, 0.0, 0.01, side * std::sqrt(1.0 - sine * sine), 1.5 * half, 1.5 * half};
      const PhotonRays by{.radius = 0.004, .photons = 2'000, .passes = 20, .seed = 2};
      expect_radiance(estimate_beam_airlight_by_photons(seen, by).unbiased, exact_radiance(seen), worst,
                      "sine " + std::to_string(side * sine));
    }
}

TEST(BeamsExtremes, BeamsAlongTheRayAreFiniteAndNothingIsDropped) {
  // The light falls along -z, the camera looks along -z through four pixels, next to the axis: the sines are some 1e-5,
  // those of light scattered before are anything.
  for (const KernelInfo& kernel : kKernels) {
    Scene scene;
    scene.media.push_back(make_medium(nullptr, Rgb(1.0f), 0.5f));
    const Interface media{0, kVacuum};
    add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
    scene.lights.push_back(BeamLight{Vec3(0, 0, 2), Vec3(0, 0, -1), 1e-4f, Rgb(1.0f)});
    scene.camera = make_camera(Vec3(0, 0, 3), Vec3(0.0f), Vec3(0, 1, 0), 1e-3f, {4, 4});
    scene.geometry.commit();
    finish(scene);
    RenderSettings settings = settings_of(20'000, 1e-4f);
    settings.volume.choose("photon-beams");
    settings.volume.kernel = kernel.kind;
    EXPECT_NE(mean_of(clean_image(scene, settings)), 0.0) << kernel.name;
  }
}

TEST(BeamsExtremes, LightExactlyAlongTheRayIsFound) {
  // In the midst of beams that leave the eye: lines without a common perpendicular. It comes from collisions, or from
  // beams around points.
  Worst worst("relative error of photon beams exactly along the ray");
  const BeamAirlight along{1.0, 1.0, 0.0, 0.1, 1.0, 1.0, 1.0};
  const double exact = 1.0 / (8.0 * kPiD);  // the integral of exp(-2 t) / (4 pi)
  for (const std::string_view type : kOfBeams) {
    const PhotonRays by{.type = type, .radius = 0.04, .photons = 2'000, .passes = 20, .seed = 3};
    expect_radiance(estimate_beam_airlight_by_photons(along, by).unbiased, exact, worst, "along the ray");
  }
}

TEST(BeamsExtremes, BeamsAThousandKilometresLongAreMetWhereTheyBegin) {
  // Positions on such beams are known to a centimetre. The light is a metre beside the ray.
  Worst worst("relative error of photon beams 1 km to 1000 km long");
  for (const double sigma : {1e-3, 1e-6}) {
    const Airlight seen{sigma, 1.0, 0.0, 1.0, 0.5, 0.0, HUGE_VAL};
    const PhotonRays by{.radius = 0.3, .photons = 2'000, .passes = 40, .seed = 4};
    const double exact =
        exact::solve_airlight({seen.sigma_t, seen.albedo, seen.g, seen.distance, seen.t_light, seen.t0, seen.t1})
            .radiance.value;
    expect_radiance(estimate_airlight_by_photons(seen, by).unbiased, exact, worst, "sigma_t " + std::to_string(sigma));
  }
}

TEST(BeamsExtremes, SlabsFromNextToNothingToOpaqueAreSeenExactly) {
  // In the thin slab, one photon in 10000 collides, but all of them fly. In the thick one, flights are a ten thousandth
  // of the radius long.
  Worst worst("relative error of photon beams, tau 1e-4 to 1e4");
  for (const std::string_view type : kOfBeams)
    for (const double tau : {1e-4, 1.0, 1e4}) {
      const exact::SlabSolution exact =
          exact::solve_slab({tau < 1e3 ? tau : HUGE_VAL, 0.5, {1.0}, {}}, {{}, {0.6}, {}});
      const bool opaque = tau > 1e3;
      if (opaque && type == "beams-points") continue;  // steps of half a flight: 10 minutes
      const PhotonRays by{.type = type,
                          .radius = opaque ? 1.0 : 0.2,
                          .photons = opaque ? 8'000u : 1'000u,
                          .passes = opaque ? 100 : 20,
                          .seed = 5};
      const SlabSights found = estimate_slab_radiance_by_photons(homogeneous_slab(tau, 0.5, 0.0, Incidence::collimated),
                                                                 {{0.6, false}, {0.6, true}}, {}, by);
      const std::string what = "tau " + std::to_string(tau);
      expect_radiance(found.exits[0].wide, exact.reflected_radiance.values[0], worst, what + ", reflected");
      if (opaque)
        EXPECT_EQ(found.exits[1].wide.mean(), 0.0) << what;
      else
        expect_radiance(found.exits[1].wide, exact.transmitted_radiance.values[0], worst, what + ", transmitted");
    }
}

}  // namespace
}  // namespace vpm
