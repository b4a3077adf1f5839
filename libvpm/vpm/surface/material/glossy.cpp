// Materials with glossy lobes: Phong's, made to conserve energy, and surfaces of microfacets: metal that reflects, and
// dielectrics that reflect and refract.
#include <cassert>

#include "vpm/base/warp.h"
#include "vpm/surface/material/facet_loss.h"
#include "vpm/surface/material/fresnel.h"
#include "vpm/surface/material/kinds.h"
#include "vpm/surface/material/microfacet.h"

namespace vpm {

// Phong's material, made to conserve energy: a diffuse and a glossy lobe, one of which each path is sent into by
// chance.
namespace {

/// The probability of the glossy lobe.
float glossy_choice(const Phong& m) {
  const float diffuse = max_channel(m.diffuse), glossy = max_channel(m.glossy);
  return glossy > 0.0f ? glossy / (diffuse + glossy) : 0.0f;
}

}  // namespace

/// Russian roulette between the lobes [Lafortune1994; Jensen2001, ch. 5]. The density is that of both lobes
/// together, so the weight does not depend on which one was chosen.
Scatter sample(const Phong& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u) {
  const Incidence in(normal, travel);
  Vec3 direction;
  if (u_choice < glossy_choice(m)) {
    // The cosine to the axis is u^(1 / (exponent + 1)).
    const auto away = static_cast<float>(-std::expm1(std::log1p(-double{u.x}) / (m.exponent + 1.0)));
    direction = direction_about(mirrored(in, travel), away, 2.0f * kPi * u.y);
  } else {
    direction = cosine_hemisphere(in.normal, u);
  }
  if (!(glm::dot(in.normal, direction) > 0.0f)) return absorbed(in);
  direction = on_side(direction, in.normal);
  return scattered(direction, value(m, normal, travel, direction), false);
}

/// diffuse/pi + glossy (n + 2)/(2 pi) cos^n [Lafortune1994]; the densities of the lobes are cos/pi and
/// (n + 1)/(2 pi) cos^n.
ScatterValue value(const Phong& m, const Vec3& normal, const Vec3& travel, const Vec3& direction) {
  const Incidence in(normal, travel);
  const float cosine = glm::dot(in.normal, direction);
  if (!(cosine > 0.0f)) return {};
  const Vec3 apart = direction - mirrored(in, travel);
  const float away = 0.5f * glm::dot(apart, apart);  // 1 - cosine to the axis, exact in narrow lobes
  const double power = away < 1.0f ? std::exp(m.exponent * std::log1p(-double{away})) : 0.0;
  const auto lobe = static_cast<float>(power / (2.0 * kPiD));
  const float glossy = glossy_choice(m);
  return {(m.diffuse / kPi + m.glossy * ((m.exponent + 2.0f) * lobe)) * cosine,
          (1.0f - glossy) * cosine / kPi + glossy * (m.exponent + 1.0f) * lobe};
}

namespace {

/// The frame of Microfacets about the normal on the path's side.
class Frame {
 public:
  explicit Frame(const Vec3& n) : n_(n) { make_frame(n, s_, t_); }
  Vec3 to_local(const Vec3& d) const { return {glm::dot(d, s_), glm::dot(d, t_), glm::dot(d, n_)}; }
  Vec3 to_world(const Vec3& d) const { return d.x * s_ + d.y * t_ + d.z * n_; }

 private:
  Vec3 s_, t_, n_;
};

}  // namespace

Scatter sample(const RoughConductor& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u) {
  const Incidence in(normal, travel);
  if (m.loss && u_choice < m.loss->lost(true, in.cosine)) {
    const Vec3 direction = on_side(cosine_hemisphere(in.normal, u), in.normal);
    return scattered(direction, value(m, normal, travel, direction), false);
  }
  const Frame frame(in.normal);
  const Vec3 v = frame.to_local(-travel), h = Microfacets(m.roughness).sample_visible(v, u);
  const Vec3 w = 2.0f * glm::dot(v, h) * h - v;
  if (!(w.z > 0.0f)) return absorbed(in);
  const Vec3 direction = on_side(frame.to_world(w), in.normal);
  return scattered(direction, value(m, normal, travel, direction), false);
}

/// [Walter2007, eq. 20] with the solid angle of h over that of w, 1 / (4 cos), of [Walter2007, eq. 14].
ScatterValue value(const RoughConductor& m, const Vec3& normal, const Vec3& travel, const Vec3& direction) {
  const Incidence in(normal, travel);
  const Frame frame(in.normal);
  const Vec3 v = frame.to_local(-travel), w = frame.to_local(direction);
  if (!(w.z > 0.0f)) return {};
  const Vec3 h = glm::normalize(v + w);
  const Microfacets microfacets(m.roughness);
  const Rgb reflectance = fresnel_conductor(std::clamp(glm::dot(v, h), 0.0f, 1.0f), m.eta, m.k);
  const float facets = 0.25f * microfacets.density(h);  // that scatter so, times the cosine to v, 1/sr of w
  const ScatterValue once{reflectance * (facets * microfacets.shadowing(v, w) * w.z), facets * microfacets.masking(v)};
  if (!m.loss) return once;
  const float lost = m.loss->lost(true, v.z);
  return {once.value + m.loss->lobe(true, v.z, false, w.z) * w.z, std::lerp(once.pdf, w.z / kPi, lost)};
}

/// The lobes of what would be lost, or a facet, which then reflects with its probability by Fresnel.
Scatter sample(const RoughDielectric& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u) {
  const Incidence in(normal, travel);
  const float eta = in.from_outside ? m.ior : 1.0f / m.ior;
  const float lost = m.loss ? m.loss->lost(in.from_outside, in.cosine) : 0.0f;
  if (u_choice < lost) {
    const bool transmitted = u_choice >= lost * m.loss->returned(in.from_outside);
    const Vec3 side = transmitted ? -in.normal : in.normal;
    const Vec3 direction = on_side(cosine_hemisphere(side, u), side);
    return scattered(direction, value(m, normal, travel, direction), transmitted);
  }
  const Frame frame(in.normal);
  const Vec3 v = frame.to_local(-travel), h = Microfacets(m.roughness).sample_visible(v, u);
  const float cosine = std::clamp(glm::dot(v, h), 0.0f, 1.0f);
  const bool transmitted = (u_choice - lost) >= (1.0f - lost) * fresnel_dielectric(cosine, eta);
  const Vec3 w = transmitted ? (cosine / eta - cos_transmitted(cosine, eta)) * h - v / eta : 2.0f * cosine * h - v;
  if (!(transmitted ? w.z < 0.0f : w.z > 0.0f)) return absorbed(in);
  const Vec3 direction = on_side(frame.to_world(w), transmitted ? -in.normal : in.normal);
  return scattered(direction, value(m, normal, travel, direction), transmitted);
}

namespace {

/// [Walter2007, eq. 20, 21], with the solid angles of [Walter2007, eq. 14, 17]; as printed, eq. 21 scatters flux. `v`
/// and `w` are local; eta is the index beyond over that before the surface.
ScatterValue scattered_once(const RoughDielectric& m, float eta, const Vec3& v, const Vec3& w) {
  const bool transmitted = w.z < 0.0f;
  const Vec3 across = transmitted ? v + eta * w : v + w;  // along the normal of the facet that scatters so
  const Vec3 h = glm::normalize(across.z < 0.0f ? -across : across);
  const float cosine = glm::dot(v, h), cos_after = transmitted ? -glm::dot(w, h) : cosine;
  if (!(cosine > 0.0f && cos_after > 0.0f)) return {};  // no facet does
  const Microfacets microfacets(m.roughness);
  const float reflectance = fresnel_dielectric(std::min(1.0f, cosine), eta);
  const float share = transmitted ? 1.0f - reflectance : reflectance;
  const float jacobian = transmitted ? cosine * eta * eta * cos_after / glm::dot(across, across) : 0.25f;
  const float facets = share * jacobian * microfacets.density(h);
  return {Rgb(facets * microfacets.shadowing(v, w) * std::abs(w.z)), facets * microfacets.masking(v)};
}

}  // namespace

ScatterValue value(const RoughDielectric& m, const Vec3& normal, const Vec3& travel, const Vec3& direction) {
  assert(m.ior != 1.0f);
  const Incidence in(normal, travel);
  const float eta = in.from_outside ? m.ior : 1.0f / m.ior;
  const Frame frame(in.normal);
  const Vec3 v = frame.to_local(-travel), w = frame.to_local(direction);
  if (w.z == 0.0f) return {};
  const bool transmitted = w.z < 0.0f;
  ScatterValue all = scattered_once(m, eta, v, w);
  all.radiance_scale = transmitted ? 1.0f / (eta * eta) : 1.0f;
  if (!m.loss) return all;
  const float cosine = std::abs(w.z), lost = m.loss->lost(in.from_outside, v.z);
  const float returned = m.loss->returned(in.from_outside), share = transmitted ? 1.0f - returned : returned;
  all.value += m.loss->lobe(in.from_outside, v.z, transmitted, cosine) * cosine;
  all.pdf = std::lerp(all.pdf, share * cosine / kPi, lost);
  return all;
}

}  // namespace vpm
