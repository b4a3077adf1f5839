// Level 4: how errors fall with the number of passes: as 1/n for the path tracer, as n^(-4/(d + 4)) for photon maps
// whose radii shrink, with kernels of dimension d [Knaus2011, sec. 4].
//
// The photon maps look at photons that fly straight from a point source to their first collision, so that field, bias
// and variance of every pass are known exactly, and with them the mean squared error after n passes, not its power law
// alone.
#include <fmt/format.h>

#include "vpm/base/parallel.h"
#include "vpm/base/statistics/line_fit.h"
#include "vpm/estimate/radius_schedule.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/film/film.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/photon/records.h"
#include "vpm/scene/build.h"
#include "vpm/study/validate/groups.h"

namespace vpm {
namespace {

/// The numbers of passes at which errors are looked at: a geometric row.
std::vector<int> pass_counts(int first, int last) {
  std::vector<int> counts;
  for (int n = first; n <= last; n *= 2) counts.push_back(n);
  return counts;
}

/// The slope of log(error) over log(n), by least squares.
double slope(const std::vector<int>& n, const std::vector<double>& errors) {
  std::vector<double> x, y;
  for (size_t i = 0; i < n.size(); ++i) {
    x.push_back(std::log(n[i]));
    y.push_back(std::log(errors[i]));
  }
  return fit_line(x, y).slope;
}

/// Independent groups of runs, each with its mean squared errors at the pass counts. run(seed) gives those of one run.
struct Groups {
  Moments slopes;
  std::vector<Moments> errors;  // at each pass count
};
template <class Run>
Groups run_groups(const std::vector<int>& n, size_t groups, const Effort& effort, const std::string& name, Run&& run) {
  constexpr size_t kRuns = 8;  // in a group: their mean is what the slope is fitted to
  std::vector<std::vector<double>> results(groups * kRuns);
  parallel_for_chunks(results.size(), 1, [&](size_t i, size_t, size_t) {
    results[i] = run(effort.seed_of(fmt::format("{} run {}", name, i)));
  });
  Groups all{{}, std::vector<Moments>(n.size())};
  for (size_t g = 0; g < groups; ++g) {
    std::vector<double> mean(n.size(), 0.0);
    for (size_t r = 0; r < kRuns; ++r)
      for (size_t k = 0; k < n.size(); ++k) mean[k] += results[g * kRuns + r][k] / kRuns;
    all.slopes.add(slope(n, mean));
    for (size_t k = 0; k < n.size(); ++k) all.errors[k].add(mean[k]);
  }
  return all;
}

/// A ball that absorbs nothing in uniform light: every pixel is 1.
std::vector<Check> path_tracer(const Effort& effort) {
  Scene scene;
  Medium medium = make_medium(nullptr, Rgb(2.0f), 1.0f);
  medium.phase = HenyeyGreenstein{0.6f};
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, SphereShape{Vec3(0.0f), 1.0f}, Boundary{}, &media);
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0, 0, 4), Vec3(0.0f), Vec3(0, 1, 0), 20.0f, {6, 6});
  scene.geometry.commit();
  finish(scene);
  const std::vector<int> n = pass_counts(8, static_cast<int>(effort.count(128, 1024)));
  const Groups groups = run_groups(n, effort.count(12, 16), effort, "path tracer", [&](uint64_t seed) {
    RenderSettings settings;
    settings.seed = seed;
    Film film(scene.camera.width, scene.camera.height);
    std::vector<double> errors;
    for (const int count : n) {
      while (film.passes() < count) film.add(film.passes(), render_path_pass(scene, settings, film.passes()).image);
      double sum = 0.0;
      for (const Rgb& pixel : film.mean().pixels) sum += (pixel.g - 1.0) * (pixel.g - 1.0) / 36.0;
      errors.push_back(sum);
    }
    return errors;
  });
  Check check = check_mean("slope of the mean squared error", groups.slopes, -1.0);
  check.note = fmt::format("{} to {} passes", n.front(), n.back());
  return {check};
}

/// A field of photons around known points, in a space of `dimension`, at which a map's estimate is compared.
struct Field {
  int dimension;
  KernelKind kernel;  // Epanechnikov's or that of order 4
  float radius;       // of the first pass, m
  double exact;       // at every one of the points
  /// Mean of the field over the points at distance s from one of them, within the space.
  std::function<double(double s)> around;
  /// The estimates of one pass at all points.
  std::function<std::vector<double>(uint64_t seed, int pass, float radius)> estimate;
};

/// The kernel of radius h at distance s, 1/m^2 or 1/m^3, written down once more.
double kernel_by_theory(const Field& field, double h, double s) {
  const double q = s * s / (h * h), measure = kPiD * std::pow(h, field.dimension);
  if (field.kernel == KernelKind::epanechnikov) return (field.dimension == 3 ? 15.0 / 8.0 : 2.0) / measure * (1.0 - q);
  return field.dimension == 3 ? 525.0 / 64.0 / measure * (1.0 - q) * (1.0 - 9.0 / 5.0 * q)
                              : 6.0 / measure * (1.0 - q) * (1.0 - 2.0 * q);
}

/// A pass of `photons` photons of together 1 W, by theory: the kernel integrated over the field.
struct PassModel {
  double bias = 0.0, variance = 0.0;
};
PassModel model_of_pass(const Field& field, double photons, double h) {
  constexpr int kShells = 400;
  double mean = 0.0, square = 0.0;
  for (int i = 0; i < kShells; ++i) {
    const double s = h * (i + 0.5) / kShells, kernel = kernel_by_theory(field, h, s);
    const double measure = (field.dimension == 3 ? 4.0 * kPiD * s * s : 2.0 * kPiD * s) * h / kShells;
    mean += kernel * field.around(s) * measure;
    square += kernel * kernel * field.around(s) * measure;
  }
  return {mean - field.exact, (square - mean * mean) / photons};
}

/// A, which is also how fast the mean squared error falls with many passes: 4/(d + 4), or 8/(d + 8) for order 4.
double exponent(const Field& field) {
  const double twice = field.kernel == KernelKind::order_4 ? 8.0 : 4.0;
  return twice / (field.dimension + twice);
}

/// The mean squared error after each of the pass counts, with radii r_{i+1}^d = r_i^d (i + A) / (i + 1).
std::vector<double> model_errors(const Field& field, double photons, const std::vector<int>& n) {
  const double d = field.dimension, a = exponent(field);
  double measure = std::pow(field.radius, d), bias = 0.0, variance = 0.0;
  std::vector<double> errors;
  for (int i = 1; i <= n.back(); ++i) {
    const PassModel pass = model_of_pass(field, photons, std::pow(measure, 1.0 / d));
    bias += pass.bias;
    variance += pass.variance;
    if (i == n[errors.size()]) errors.push_back(variance / i / i + bias / i * bias / i);
    measure *= (i + a) / (i + 1.0);
  }
  return errors;
}

constexpr uint64_t kPhotonsOfPass = 1000;

std::vector<Check> density_estimation(const Field& field, const std::string& name, const Effort& effort) {
  const std::vector<int> n = pass_counts(4, static_cast<int>(effort.count(128, 1024)));
  const Groups groups = run_groups(n, effort.count(12, 16), effort, name, [&](uint64_t seed) {
    std::vector<double> sums, errors;
    for (int pass = 0; pass < n.back(); ++pass) {
      const auto estimates =
          field.estimate(seed, pass, radius_of_pass(field.radius, field.dimension, pass, kernel_order(field.kernel)));
      sums.resize(estimates.size());
      double error = 0.0;
      for (size_t i = 0; i < sums.size(); ++i) {
        sums[i] += estimates[i];
        error += std::pow(sums[i] / (pass + 1) - field.exact, 2) / static_cast<double>(sums.size());
      }
      if (pass + 1 == n[errors.size()]) errors.push_back(error);
    }
    return errors;
  });
  const std::vector<double> model = model_errors(field, kPhotonsOfPass, n);
  const double asymptote = -exponent(field);
  std::vector<Check> checks{
      check_mean("slope of the mean squared error", groups.slopes, slope(n, model)),
      check_bound("slope by theory, and its limit of many passes", slope(n, model), asymptote, 0.06)};
  checks[0].note = fmt::format("{} to {} passes; {:.3f} for many", n.front(), n.back(), asymptote);
  for (const size_t k : {size_t{0}, n.size() - 1})
    checks.push_back(check_mean(fmt::format("mean squared error of {} passes", n[k]), groups.errors[k], model[k]));
  return checks;
}

PhotonLists trace(const Scene& scene, uint64_t seed, int pass) {
  ListSettings settings;
  settings.seed = seed;
  settings.pass = static_cast<uint64_t>(pass);
  settings.emitted = kPhotonsOfPass;
  return list_photons(scene, *make_distance_strategy({}), settings);
}

/// Of the seeds of an experiment.
std::string name_of(const std::string& where, KernelKind kernel) {
  return kernel == KernelKind::order_4 ? where + ", order 4" : where;
}

/// First collisions around an isotropic source of 1 W in a medium of sigma_t = 1/m: fluence exp(-r) / (4 pi r^2).
std::vector<Check> volume_photons(const Effort& effort, KernelKind kernel) {
  constexpr double kDistance = 1.2;  // of the points from the source, m
  Scene scene;
  // So little albedo that what scatters twice is far below the noise; without any, nothing would be stored.
  scene.media.push_back(make_medium(nullptr, Rgb(1.0f), 1e-6f));
  scene.world_medium = 0;
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f / (4.0f * kPi))});
  scene.geometry.commit();
  finish(scene);
  const std::vector<Vec3> axes{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const auto phi = [](double r) { return std::exp(-r) / (4.0 * kPiD * r * r); };
  Field field{3, kernel, 0.5f, phi(kDistance), {}, {}};
  field.around = [&](double s) {
    // The mean over a sphere of a field that depends on the distance u from the source: int phi u du / (2 r s).
    constexpr int kSteps = 200;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double u = kDistance - s + 2.0 * s * (i + 0.5) / kSteps;
      sum += phi(u) * u / kSteps;
    }
    return sum / kDistance;
  };
  field.estimate = [&, kernel](uint64_t seed, int pass, float radius) {
    const PhotonMap map =
        make_photon_map(trace(scene, seed, pass).volume[0], {.radius = radius, .kernel = kernel}, kPhotonsOfPass);
    std::vector<double> estimates;
    for (const Vec3& axis : axes)
      estimates.push_back(fluence(scene.media[0].majorant(), static_cast<float>(kDistance) * axis, map).g);
    return estimates;
  };
  return density_estimation(field, name_of("volume", kernel), effort);
}

/// Photons of an isotropic source of 1 W at height 1 m on a floor: irradiance cos / (4 pi distance^2).
std::vector<Check> surface_photons(const Effort& effort, KernelKind kernel) {
  constexpr double kFromFoot = 0.5;  // of the points, m
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-9, 0, 9), Vec3d(18, 0, 0), Vec3d(0, 0, -18)), Lambertian{Rgb(1e-6f)});
  scene.lights.push_back(PointLight{Vec3(0, 1, 0), Rgb(1.0f / (4.0f * kPi))});
  scene.geometry.commit();
  finish(scene);
  const std::vector<Vec3> axes{{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
  const auto irradiance = [](double square) { return std::pow(1.0 + square, -1.5) / (4.0 * kPiD); };
  Field field{2, kernel, 0.4f, irradiance(kFromFoot * kFromFoot), {}, {}};
  field.around = [&](double s) {
    constexpr int kSteps = 64;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double angle = 2.0 * kPiD * (i + 0.5) / kSteps;
      sum += irradiance(kFromFoot * kFromFoot + s * s + 2.0 * kFromFoot * s * std::cos(angle)) / kSteps;
    }
    return sum;
  };
  field.estimate = [&, kernel](uint64_t seed, int pass, float radius) {
    const PhotonMap map =
        make_photon_map(trace(scene, seed, pass).surface, {.radius = radius, .kernel = kernel}, kPhotonsOfPass);
    std::vector<double> estimates;
    for (const Vec3& axis : axes)
      estimates.push_back(surface_irradiance(static_cast<float>(kFromFoot) * axis, Vec3(0, 1, 0), map).value.g);
    return estimates;
  };
  return density_estimation(field, name_of("surface", kernel), effort);
}

}  // namespace

std::vector<Experiment> convergence_experiments() {
  std::vector<Experiment> all{{4, "the path tracer", path_tracer}};
  const auto add = [&](const char* name, auto* photons, KernelKind kernel) {
    all.push_back({4, name, [=](const Effort& effort) { return photons(effort, kernel); }});
  };
  add("photons in a volume, kernel of dimension 3", volume_photons, KernelKind::epanechnikov);
  add("photons on a surface, kernel of dimension 2", surface_photons, KernelKind::epanechnikov);
  add("photons in a volume, kernel of order 4", volume_photons, KernelKind::order_4);
  add("photons on a surface, kernel of order 4", surface_photons, KernelKind::order_4);
  for (auto* group : {pass_experiments, march_experiments})
    for (Experiment& e : group()) all.push_back(std::move(e));
  return all;
}

}  // namespace vpm
