// Numbers of techniques from layers whose sums are known by hand.
#include "vpm/job/found_by_techniques.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vpm/integrators/combined/technique_layers.h"

namespace vpm {
namespace {

/// Two pixels, the second black; the first has one of these values in each pass.
Film film_of_first_pixel(const std::vector<float>& values) {
  Film film(2, 1);
  for (size_t pass = 0; pass < values.size(); ++pass) {
    Image image(2, 1);
    image.at(0, 0) = Rgb(values[pass]);
    film.add(static_cast<int>(pass), image);
  }
  return film;
}

RenderSettings with_layers() {
  RenderSettings settings;
  settings.integrator = Integrator::combined;
  settings.combined.layers = true;
  return settings;
}

/// Connections find a quarter of the light and short beams the rest, in two passes.
RenderResult two_techniques() {
  RenderResult result{film_of_first_pixel({7.0f, 9.0f}), {}, 0.0, {}};
  result.layers.assign(2 * kTechniques.size(), film_of_first_pixel({0.0f, 0.0f}));
  result.layers[weighted_layer(Technique::connections)] = film_of_first_pixel({1.0f, 3.0f});
  result.layers[unweighted_layer(Technique::connections)] = film_of_first_pixel({4.0f, 4.0f});
  result.layers[weighted_layer(Technique::short_beams)] = film_of_first_pixel({6.0f, 6.0f});
  result.layers[unweighted_layer(Technique::short_beams)] = film_of_first_pixel({9.0f, 7.0f});
  return result;
}

TEST(FoundByTechniques, AreSharesAndVariancesOfLayers) {
  RenderSettings settings = with_layers();
  settings.combined.techniques.set(Technique::light_tracing, false);
  const std::vector<FoundByTechnique> found = found_by_techniques(settings, two_techniques());
  ASSERT_EQ(found.size(), 5u);  // all but three
  EXPECT_EQ(found[0].name, "connections");
  EXPECT_DOUBLE_EQ(found[0].share_of_light, 0.25);
  EXPECT_DOUBLE_EQ(found[0].found_alone, 0.5);
  // The variance of the mean of 1 and 3 is 1; R^2 is 64, the mean of R over both pixels 4.
  EXPECT_DOUBLE_EQ(found[0].variance, 0.5 / (64.0 + 0.16));
  EXPECT_EQ(found[1].name, "surface-merging");
  EXPECT_EQ(found[1].share_of_light, 0.0);
  EXPECT_EQ(found[4].name, "short-beams");
  EXPECT_DOUBLE_EQ(found[4].share_of_light, 0.75);
  EXPECT_DOUBLE_EQ(found[4].found_alone, 1.0);
  EXPECT_EQ(found[4].variance, 0.0);
}

TEST(FoundByTechniques, HavePicturesThatSumToTheWhole) {
  const RenderResult result = two_techniques();
  const std::vector<Image> parts = parts_of_techniques(with_layers(), result);
  ASSERT_EQ(parts.size(), found_by_techniques(with_layers(), result).size());
  Rgb sum(0.0f);
  for (const Image& part : parts) sum += part.at(0, 0);
  EXPECT_EQ(sum, result.film.mean().at(0, 0));
}

TEST(FoundByTechniques, AreNothingWithoutLayersOrLight) {
  RenderResult result{film_of_first_pixel({0.0f}), {}, 0.0, {}};
  EXPECT_TRUE(found_by_techniques(with_layers(), result).empty());
  EXPECT_TRUE(parts_of_techniques(with_layers(), result).empty());
  result.layers.assign(2 * kTechniques.size(), result.film);
  for (const FoundByTechnique& found : found_by_techniques(with_layers(), result)) {
    EXPECT_EQ(found.share_of_light, 0.0);
    EXPECT_EQ(found.found_alone, 0.0);
    EXPECT_TRUE(std::isnan(found.variance));  // of one pass
  }
}

TEST(FoundByTechniques, AreNotLayersOfWhatTheCameraSees) {
  RenderResult result{film_of_first_pixel({1.0f}), {}, 0.0, {}};
  RenderSettings settings;
  settings.layers.set(ViewLayer::albedo, true);
  result.layers.assign(1, result.film);
  EXPECT_TRUE(found_by_techniques(settings, result).empty());
}

}  // namespace
}  // namespace vpm
