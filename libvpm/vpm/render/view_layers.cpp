// One table says what each layer sums, and how it is written.
#include "vpm/render/view_layers.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "vpm/render/technique_layers.h"

namespace vpm {
namespace {

/// What is summed over samples.
using SumOf = Rgbd (*)(const View& view);
Rgbd distance_and_share(const View& view) { return {view.distance, view.passage.surface ? 1.0 : 0.0, 0.0}; }
Rgbd normal_of(const View& view) { return Rgbd(view.normal); }
Rgbd albedo_of(const View& view) { return view.albedo; }
Rgbd transmittance_of(const View& view) { return view.passage.transmittance; }
Rgbd scattered_of(const View& view) { return view.passage.scattered; }
Rgbd lost_of(const View& view) { return view.passage.lost; }

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
  bool is_mean() const { return finish == mean_itself && !sums.empty(); }  // passes tell its variance
};

const LayerKind& kind_of_layer(ViewLayer layer) {
  static const std::array<LayerKind, kViewLayers.size()> kinds{{{"Z", {distance_and_share}, depth_of},
                                                                {"XYZ", {normal_of}},
                                                                {"RGB", {albedo_of}},
                                                                {"RGB", {transmittance_of}},
                                                                {"RGB", {scattered_of, lost_of}, scattered_over_lost},
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

size_t layer_films(const RenderSettings& settings) {
  return layer_names(settings).size() + view_films(settings.layers);
}

size_t layer_channels(const RenderSettings& settings) {
  constexpr size_t kOfTechniqueLayer = 6;
  size_t channels = kOfTechniqueLayer * layer_names(settings).size();
  for_each_layer(settings.layers, [&](const ViewLayerInfo&, const LayerKind& kind) {
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

std::vector<NamedLayer> named_view_layers(const RenderSettings& settings, const Film& picture,
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
