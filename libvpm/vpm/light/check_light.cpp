// The ranges of what lights emit, of where they stand and where they point.
#include "vpm/light/check_light.h"

#include <algorithm>

#include "vpm/base/overloads.h"

namespace vpm {
namespace {

/// The first clause that says something.
std::string first_of(std::initializer_list<std::string> clauses) {
  const auto found = std::find_if(clauses.begin(), clauses.end(), [](const std::string& c) { return !c.empty(); });
  return found == clauses.end() ? "" : *found;
}

std::string emitted_problem(const std::string& name, const Rgb& emitted) {
  if (!is_finite(emitted) || std::min({emitted.r, emitted.g, emitted.b}) < 0.0f)
    return "its " + name + " must be at least 0 and finite";
  return is_black(emitted) ? "its " + name + " is 0: it emits nothing" : "";
}

std::string position_problem(const Vec3& position) { return is_finite(position) ? "" : "its position must be finite"; }

std::string direction_problem(const Vec3& direction) {
  constexpr float kRounding = 1e-4f;
  return std::abs(glm::length(direction) - 1.0f) < kRounding ? "" : "its direction must be a unit vector";
}

std::string radius_problem(float radius) {
  return radius > 0.0f && std::isfinite(radius) ? "" : "its radius must be positive and finite";
}

std::string cone_problem(const SpotLight& l) {
  const bool in_order = l.cos_inner <= 1.0f && l.cos_inner >= l.cos_outer && l.cos_outer >= -1.0f;
  if (!in_order) return "the cosines of its cones must lie in [-1, 1], the inner one's not below the outer one's";
  return l.cos_outer < 1.0f ? "" : "its outer cone must be open: a beam light is the narrow one";
}

}  // namespace

std::string problem_of(const Light& light) {
  return std::visit(
      Overloads{[](const PointLight& l) {
                  return first_of({position_problem(l.position), emitted_problem("intensity", l.intensity)});
                },
                [](const SpotLight& l) {
                  return first_of({position_problem(l.position), direction_problem(l.direction), cone_problem(l),
                                   emitted_problem("intensity", l.intensity)});
                },
                [](const BeamLight& l) {
                  return first_of({position_problem(l.position), direction_problem(l.direction),
                                   radius_problem(l.radius), emitted_problem("power", l.power)});
                },
                [](const AreaLight auto& l) { return emitted_problem("radiance", l.radiance); },
                [](const DirectionalLight& l) {
                  return first_of({direction_problem(l.direction), emitted_problem("irradiance", l.irradiance)});
                },
                [](const ConstantEnvironment& l) { return emitted_problem("radiance", l.radiance); },
                [](const EnvironmentMap& l) { return std::string(l.image ? "" : "it lacks its picture"); }},
      light);
}

}  // namespace vpm
