// Straight on to the first surface, and through specular ones from there. One table says what each layer sums, and how
// it is written.
#include "vpm/film/view_layers.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "vpm/base/overloads.h"
#include "vpm/medium/emission.h"
#include "vpm/path/both_sides.h"
#include "vpm/path/segments.h"
#include "vpm/surface/material/fresnel.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

/// The visitor of a ray's segments.
struct Passing {
  const Scene& scene;
  const Ray& ray;
  const MediumId& number;
  Passage& passage;

  bool pass(float length, const Encounter&) {
    if (number == kVacuum) return true;
    const Medium& medium = scene.media[number];
    if (medium.emits()) {
      uint64_t uncounted = 0;
      passage.emission += passage.transmittance * Rgbd(emitted_along(medium, ray, {0.0f, length}, uncounted).radiance);
    }
    const double integral = density_integral(medium, ray, {0.0f, length}).value;
    const Rgb albedo = medium.albedo();
    for (int c = 0; c < 3; ++c) {
      if (medium.sigma_t[c] == 0.0f) continue;  // also of an endless segment
      const double optical = double{medium.sigma_t[c]} * integral;
      const double lost = passage.transmittance[c] * -std::expm1(-optical);
      passage.lost[c] += lost;
      passage.scattered[c] += double{albedo[c]} * lost;
      passage.transmittance[c] *= std::exp(-optical);
    }
    return true;
  }
};

/// Of a material that is not specular, whatever the direction; nothing of those that are.
std::optional<Rgb> reflectance_at_all(const Material& material) {
  using Reflectance = std::optional<Rgb>;
  return std::visit(Overloads{[](const Lambertian& m) { return Reflectance(m.reflectance); },
                              [](const Phong& m) { return Reflectance(m.diffuse + m.glossy); },
                              [](const RoughConductor& m) { return Reflectance(fresnel_conductor(1.0f, m.eta, m.k)); },
                              [](const RoughDielectric&) { return Reflectance(Rgb(1.0f)); },
                              [](const auto&) { return Reflectance(); }},
                    material);
}

/// Where a path from the camera is, which only specular surfaces have turned.
struct Sight {
  Ray ray;
  MediumId medium = kVacuum;
  float part = 1.0f;  // of the light of the camera's ray, as glass has divided it
  int specular = 0;   // surfaces so far
};

Rgbd albedo_after(const Scene& scene, const Passage& passage, const Sight& at);

/// Of what lies behind a specular surface, in the direction that `scatter` turns to.
Rgbd albedo_beyond(const Scene& scene, const Hit& hit, const Scatter& scatter, float fraction, const Sight& at) {
  if (is_black(scatter.weight)) return Rgbd(0.0);
  PathState state{at.ray, at.medium};
  leave_along(scene, hit, scatter, state);
  Sight next{state.ray, state.medium, at.part * fraction, at.specular + 1};
  const Passage passage = pass_media(scene, next.ray, next.medium);
  return Rgbd(scatter.weight) * albedo_after(scene, passage, next);
}

Rgbd albedo_at(const Scene& scene, const Hit& hit, const Sight& at) {
  const Material material = material_at(scene, hit);
  if (const std::optional<Rgb> reflectance = reflectance_at_all(material)) return Rgbd(*reflectance);
  if (at.specular == kMostSpecular) return Rgbd(1.0);
  const Vec3& travel = at.ray.direction;
  if (const std::optional<BothSides> sides = both_sides(material, hit, travel, at.part)) {
    const double back = sides->reflected, beyond = 1.0 - back;
    return back * albedo_beyond(scene, hit, sides->back, sides->reflected, at) +
           beyond * albedo_beyond(scene, hit, sides->beyond, 1.0f - sides->reflected, at);
  }
  constexpr float kStrongerSide = 0.5f;  // reflects where more than that is reflected
  return albedo_beyond(scene, hit, sample_scatter(material, hit, travel, kStrongerSide, Vec2(0.0f)), 1.0f, at);
}

Rgbd albedo_after(const Scene& scene, const Passage& passage, const Sight& at) {
  if (!passage.surface) return passage.scattered;
  return passage.scattered + passage.transmittance * albedo_at(scene, *passage.surface, at);
}

}  // namespace

Passage pass_media(const Scene& scene, Ray& ray, MediumId& medium) {
  Passage passage;
  WalkCounters uncounted;  // the report counts what estimates of light do
  passage.surface = each_segment(scene, ray, medium, kInfinity, uncounted, Passing{scene, ray, medium, passage});
  return passage;
}

View view_along(const Scene& scene, const Ray& camera_ray) {
  Sight at{camera_ray, medium_of_ray(scene, scene.camera_medium, camera_ray)};
  View view;
  view.passage = pass_media(scene, at.ray, at.medium);
  if (const std::optional<Hit>& surface = view.passage.surface) {
    view.distance = glm::distance(Vec3d(camera_ray.origin), Vec3d(surface->position));
    const bool before = glm::dot(surface->normal, camera_ray.direction) < 0.0f;
    view.normal = before ? surface->shading_normal : -surface->shading_normal;
  }
  view.albedo = albedo_after(scene, view.passage, at);
  return view;
}

namespace {

/// What is summed over samples.
using SumOf = Rgbd (*)(const View& view);
Rgbd distance_and_share(const View& view) { return {view.distance, view.passage.surface ? 1.0 : 0.0, 0.0}; }
Rgbd normal_of(const View& view) { return Rgbd(view.normal); }
Rgbd albedo_of(const View& view) { return view.albedo; }
Rgbd transmittance_of(const View& view) { return view.passage.transmittance; }
Rgbd scattered_of(const View& view) { return view.passage.scattered; }
Rgbd lost_of(const View& view) { return view.passage.lost; }
Rgbd emission_of(const View& view) { return view.passage.emission; }

/// What is written of the means of these sums.
using Finish = Image (*)(std::span<const Image> means);
Image mean_itself(std::span<const Image> means) { return means[0]; }

Image depth_of(std::span<const Image> means) {
  Image depth = means[0];
  for (Rgb& pixel : depth.pixels) pixel = Rgb(pixel.g > 0.0f ? pixel.r / pixel.g : kNoDepth);
  return depth;
}

Image scattered_over_lost(std::span<const Image> means) {
  Image ratio = means[0];
  for (size_t i = 0; i < ratio.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float lost = means[1].pixels[i][c];
      ratio.pixels[i][c] = lost > 0.0f ? ratio.pixels[i][c] / lost : 0.0f;
    }
  return ratio;
}

struct LayerKind {
  std::string_view letters;  // of its channels
  std::vector<SumOf> sums;   // a film each; none: the number of samples
  Finish finish = mean_itself;
  bool is_mean() const { return finish == mean_itself && !sums.empty(); }  // its variance is estimated from passes
};

const LayerKind& kind_of_layer(ViewLayer layer) {
  static const std::array<LayerKind, kViewLayers.size()> kinds{{{"Z", {distance_and_share}, depth_of},
                                                                {"XYZ", {normal_of}},
                                                                {"RGB", {albedo_of}},
                                                                {"RGB", {transmittance_of}},
                                                                {"RGB", {scattered_of, lost_of}, scattered_over_lost},
                                                                {"RGB", {emission_of}},
                                                                {"X", {}}}};
  return kinds[static_cast<size_t>(layer)];
}

/// Calls visit(info, kind) for each layer of a set.
template <class Visit>
void for_each_layer(const ViewLayerSet& layers, Visit&& visit) {
  for (const ViewLayerInfo& info : kViewLayers)
    if (layers.has(info.layer)) visit(info, kind_of_layer(info.layer));
}

Image constant(const Film& picture, float value) {
  Image image(picture.width(), picture.height());
  std::fill(image.pixels.begin(), image.pixels.end(), Rgb(value));
  return image;
}

}  // namespace

size_t view_films(const ViewLayerSet& layers) {
  size_t films = 0;
  for_each_layer(layers, [&](const ViewLayerInfo&, const LayerKind& kind) { films += kind.sums.size(); });
  return films;
}

size_t view_channels(const ViewLayerSet& layers) {
  size_t channels = 0;
  for_each_layer(layers, [&](const ViewLayerInfo&, const LayerKind& kind) {
    channels += kind.letters.size() * (kind.is_mean() ? 2 : 1);
  });
  return channels;
}

ViewSums::ViewSums(const ViewLayerSet& layers, int width, int height)
    : width_(width),
      height_(height),
      layers_(layers),
      films_(view_films(layers)),
      sums_(films_ * static_cast<size_t>(width) * static_cast<size_t>(height), Rgbd(0.0)) {}

void ViewSums::add(size_t pixel, const View& view) {
  Rgbd* sum = sums_.data() + films_ * pixel;
  for_each_layer(layers_, [&](const ViewLayerInfo&, const LayerKind& kind) {
    for (const SumOf of : kind.sums) *sum++ += of(view);
  });
}

std::vector<Image> ViewSums::means(int samples) const {
  std::vector<Image> means(films_, Image(width_, height_));
  for (size_t i = 0; i < sums_.size(); ++i)
    means[i % films_].pixels[i / films_] = Rgb(sums_[i] / static_cast<double>(samples));
  return means;
}

std::vector<NamedLayer> named_view_layers(const PassSettings& settings, const Film& picture,
                                          std::span<const Film> films) {
  assert(films.size() == view_films(settings.layers));
  const auto samples = static_cast<float>(static_cast<double>(settings.samples_per_pixel) * picture.passes());
  std::vector<NamedLayer> named;
  for_each_layer(settings.layers, [&](const ViewLayerInfo& info, const LayerKind& kind) {
    const std::string name(info.name), letters(kind.letters);
    std::vector<Image> means;
    for (const Film& film : films.first(kind.sums.size())) means.push_back(film.mean());
    named.push_back({name, letters, means.empty() ? constant(picture, samples) : kind.finish(means)});
    if (kind.is_mean() && picture.passes() > 1)
      named.push_back({name + "-variance", letters, films.front().variance_of_mean()});
    films = films.subspan(kind.sums.size());
  });
  return named;
}

}  // namespace vpm
