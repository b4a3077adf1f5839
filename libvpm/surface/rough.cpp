// Surfaces of microfacets: metal that reflects, and dielectrics that reflect and refract.
#include <cassert>

#include "surface/fresnel.h"
#include "surface/kinds.h"
#include "surface/microfacet.h"

namespace vpm {

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

Scatter sample(const RoughConductor& m, const Vec3& normal, const Vec3& travel, float, const Vec2& u) {
  const Incidence in(normal, travel);
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
  return {reflectance * (facets * microfacets.shadowing(v, w) * w.z), facets * microfacets.masking(v)};
}

/// The facet is drawn first; it then reflects with its probability by Fresnel.
Scatter sample(const RoughDielectric& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u) {
  const Incidence in(normal, travel);
  const float eta = in.from_outside ? m.ior : 1.0f / m.ior;
  const Frame frame(in.normal);
  const Vec3 v = frame.to_local(-travel), h = Microfacets(m.roughness).sample_visible(v, u);
  const float cosine = std::clamp(glm::dot(v, h), 0.0f, 1.0f);
  const bool transmitted = u_choice >= fresnel_dielectric(cosine, eta);
  const Vec3 w = transmitted ? (cosine / eta - cos_transmitted(cosine, eta)) * h - v / eta : 2.0f * cosine * h - v;
  if (!(transmitted ? w.z < 0.0f : w.z > 0.0f)) return absorbed(in);
  const Vec3 direction = on_side(frame.to_world(w), transmitted ? -in.normal : in.normal);
  return scattered(direction, value(m, normal, travel, direction), transmitted);
}

/// [Walter2007, eq. 20, 21], with the solid angles of [Walter2007, eq. 14, 17]; as printed, eq. 21 scatters flux.
ScatterValue value(const RoughDielectric& m, const Vec3& normal, const Vec3& travel, const Vec3& direction) {
  assert(m.ior != 1.0f);
  const Incidence in(normal, travel);
  const float eta = in.from_outside ? m.ior : 1.0f / m.ior;
  const Frame frame(in.normal);
  const Vec3 v = frame.to_local(-travel), w = frame.to_local(direction);
  const bool transmitted = w.z < 0.0f;
  const Vec3 across = transmitted ? v + eta * w : v + w;  // along the normal of the facet that scatters so
  const Vec3 h = glm::normalize(across.z < 0.0f ? -across : across);
  const float cosine = glm::dot(v, h), cos_after = transmitted ? -glm::dot(w, h) : cosine;
  if (!(w.z != 0.0f && cosine > 0.0f && cos_after > 0.0f)) return {};  // no facet does
  const Microfacets microfacets(m.roughness);
  const float reflectance = fresnel_dielectric(std::min(1.0f, cosine), eta);
  const float share = transmitted ? 1.0f - reflectance : reflectance;
  const float jacobian = transmitted ? cosine * eta * eta * cos_after / glm::dot(across, across) : 0.25f;
  const float facets = share * jacobian * microfacets.density(h);
  return {Rgb(facets * microfacets.shadowing(v, w) * std::abs(w.z)), facets * microfacets.masking(v),
          transmitted ? 1.0f / (eta * eta) : 1.0f};
}

}  // namespace vpm
