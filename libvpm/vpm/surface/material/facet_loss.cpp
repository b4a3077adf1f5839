// Integrals of main lobes by the midpoint rule over the numbers that draw visible normals.
#include "vpm/surface/material/facet_loss.h"

#include <algorithm>
#include <cmath>

#include "vpm/surface/material/fresnel.h"
#include "vpm/surface/material/microfacet.h"

namespace vpm {
namespace {

constexpr int kRings = 192, kTurns = 64;     // points of the rule, along each of the two numbers
constexpr float kBelowOne = 0x1.fffffep-1f;  // the largest number that draws normals
constexpr float kLeastCosine = 1e-4f;        // stands for grazing light
constexpr double kLeastLoss = 1e-7;          // means below it are rounding

Vec3 at_cosine(float cosine) { return {std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)), 0.0f, cosine}; }

/// The mean over visible normals h, seen from v, of what keep(h) keeps. The first number that draws normals is
/// 1 - s^3 with s even: of smooth surfaces only the few facets with numbers close to 1 lose anything. The second one is
/// below 1/2, as facets are alike on both sides of the plane of v.
template <class Keep>
float mean_over_facets(const Microfacets& facets, const Vec3& v, Keep&& keep) {
  double sum = 0.0, all = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double s = (i + 0.5) / kRings, weight = s * s;
    const float first = std::min(kBelowOne, static_cast<float>(1.0 - s * s * s));
    for (int j = 0; j < kTurns; ++j) {
      sum += weight * keep(facets.sample_visible(v, {first, (static_cast<float>(j) + 0.5f) / (2 * kTurns)}));
      all += weight;
    }
  }
  return static_cast<float>(sum / all);
}

/// Of light sent from v to w, the share that no other facet is in the way of.
float unshadowed(const Microfacets& facets, const Vec3& v, const Vec3& w) {
  return facets.shadowing(v, w) * std::abs(w.z) / facets.masking(v);
}

float kept_by_mirrors(const Microfacets& facets, float cosine) {
  const Vec3 v = at_cosine(cosine);
  return mean_over_facets(facets, v, [&](const Vec3& h) {
    const Vec3 w = 2.0f * glm::dot(v, h) * h - v;
    return w.z > 0.0f ? unshadowed(facets, v, w) : 0.0f;
  });
}

/// `eta`: the index beyond over that before the surface.
float kept_by_dielectric(const Microfacets& facets, float eta, float cosine) {
  const Vec3 v = at_cosine(cosine);
  return mean_over_facets(facets, v, [&](const Vec3& h) {
    const float c = std::clamp(glm::dot(v, h), 0.0f, 1.0f), reflected = fresnel_dielectric(c, eta);
    const Vec3 back = 2.0f * c * h - v;
    float kept = back.z > 0.0f ? reflected * unshadowed(facets, v, back) : 0.0f;
    if (reflected < 1.0f) {
      const Vec3 through = (c / eta - cos_transmitted(c, eta)) * h - v / eta;
      if (through.z < 0.0f) kept += (1.0f - reflected) * unshadowed(facets, v, through);
    }
    return kept;
  });
}

/// The mean reflectance of smooth metal in light from everywhere, 2 int F(c) c dc.
Rgb mean_reflectance(const RoughConductor& m) {
  Rgbd sum(0.0);
  for (int i = 0; i < kRings; ++i) {
    const float cosine = (static_cast<float>(i) + 0.5f) / kRings;
    sum += Rgbd(fresnel_conductor(cosine, m.eta, m.k)) * (2.0 * cosine / kRings);
  }
  return Rgb(sum);
}

}  // namespace

template <class Kept>
FacetLoss::Side FacetLoss::integrate(Kept&& kept) {
  Side side;
  const double step = 1.0 / (kCosines - 1);
  for (int i = 0; i < kCosines; ++i) {
    const float cosine = std::max(kLeastCosine, static_cast<float>(i * step));
    side.lost[static_cast<size_t>(i)] = std::max(0.0f, 1.0f - kept(cosine));
  }
  // 2 int lost(c) c dc of the values joined by straight lines, as lost() joins them: then what is lost returns exactly.
  for (int i = 0; i + 1 < kCosines; ++i) {
    const double a = side.lost[static_cast<size_t>(i)], b = side.lost[static_cast<size_t>(i) + 1], c = i * step;
    side.mean += 2.0 * step * (0.5 * c * (a + b) + step * (a / 6.0 + b / 3.0));
  }
  return side;
}

/// Light that has met all facets it can meets metal of mean reflectance F again and again: of it F^2 E / (1 - F (1 -
/// E)) comes back, E the share of light from everywhere that leaves after one reflection [Kulla2017].
FacetLoss::FacetLoss(const RoughConductor& material) {
  const Microfacets facets(material.roughness);
  sides_[0] = integrate([&](float cosine) { return kept_by_mirrors(facets, cosine); });
  sides_[1] = sides_[0];
  const auto leaves = static_cast<float>(1.0 - sides_[0].mean);
  const Rgb f = mean_reflectance(material);
  tint_ = f * f * leaves / (Rgb(1.0f) - f * (1.0f - leaves));
}

/// Reciprocity of BSDFs over the square of the index of the side they scatter to: the light that passes from either
/// side, a_i L_i n_i^2, is the same, for the mean losses L and indices n; so much that neither a exceeds 1.
FacetLoss::FacetLoss(const RoughDielectric& material) {
  const Microfacets facets(material.roughness);
  sides_[0] = integrate([&](float cosine) { return kept_by_dielectric(facets, material.ior, cosine); });
  sides_[1] = integrate([&](float cosine) { return kept_by_dielectric(facets, 1.0f / material.ior, cosine); });
  const double outside = sides_[0].mean, inside = sides_[1].mean * material.ior * material.ior;
  if (!(outside + inside > 0.0)) return;
  sides_[0].returned = static_cast<float>(outside / (outside + inside));
  sides_[1].returned = static_cast<float>(inside / (outside + inside));
}

float FacetLoss::lost(bool outside, float cosine) const {
  const float place = std::clamp(cosine, 0.0f, 1.0f) * (kCosines - 1);
  const int i = std::min(static_cast<int>(place), kCosines - 2);
  const auto& values = side(outside).lost;
  return std::lerp(values[static_cast<size_t>(i)], values[static_cast<size_t>(i) + 1], place - static_cast<float>(i));
}

Rgb FacetLoss::lobe(bool outside, float cosine, bool transmitted, float cosine_after) const {
  const bool outside_after = outside != transmitted;
  const Side& after = side(outside_after);
  if (after.mean < kLeastLoss) return Rgb(0.0f);
  const float share = transmitted ? 1.0f - side(outside).returned : side(outside).returned;
  return tint_ *
         (share * lost(outside, cosine) * lost(outside_after, cosine_after) / static_cast<float>(kPiD * after.mean));
}

std::shared_ptr<const FacetLoss> facet_loss_of(const Material& material) {
  if (const auto* metal = std::get_if<RoughConductor>(&material)) return std::make_shared<FacetLoss>(*metal);
  if (const auto* glass = std::get_if<RoughDielectric>(&material)) return std::make_shared<FacetLoss>(*glass);
  return nullptr;
}

void set_facet_loss(Material& material, const FacetLoss* loss) {
  if (auto* metal = std::get_if<RoughConductor>(&material)) metal->loss = loss;
  if (auto* glass = std::get_if<RoughDielectric>(&material)) glass->loss = loss;
}

}  // namespace vpm
