// The integrators: what estimates the radiance along the camera's rays. One list, of which scenes name one.
//
// An integrator describes its settings, says what a scene must have for them, and makes passes. The film and the loop
// over passes know none.
#pragma once

#include <string>
#include <vector>

#include "vpm/film/image_pass.h"
#include "vpm/image/image.h"
#include "vpm/integrators/choice.h"
#include "vpm/integrators/render_scene.h"

namespace vpm {

class Description;

/// A pass with its photons or light sub-paths ready, of which a pilot follows only some rays.
struct RaysOfPass {
  RadianceOfRays radiance;  // keeps what it reads
  Image light_tracing;      // what light sub-paths add to each pixel; empty where the integrator has none
  RenderStatistics statistics{};
  int square = 1;  // of pixels that share what one gathers: render_image()
};

/// A way to render: an integrator and the components that it uses.
struct Way {
  std::string name;  // "photon-map by beam"
  RenderSettings settings;
};

struct IntegratorInfo {
  /// Its settings, but for `type` of [integrator].
  void (*describe)(RenderSettings&, Description&);
  /// Throws a SettingError where settings contradict each other or the scene; null: they do not.
  void (*check)(const RenderSettings&, const SceneFacts&) = nullptr;
  /// Passes of the whole film, without the camera's crop.
  PassMaker (*passes)(const Scene&, const RenderSettings&);
  RaysOfPass (*rays)(const Scene&, const RenderSettings&, int pass);
  /// See gathers(), stage_lines(), layer_names(), integrator_warnings(). Null: it never gathers, has no layers, warns
  /// of nothing.
  bool (*gathers)(const Scene&, const RenderSettings&) = nullptr;
  std::vector<std::string> (*stages)(const Scene&, const RenderSettings&, const SceneFacts& shown);
  std::vector<std::string> (*layers)(const RenderSettings&) = nullptr;
  std::vector<std::string> (*warnings)(const SceneFacts& shown, const RenderSettings&,
                                       const RenderStatistics&) = nullptr;
  /// The ways to render by it that are worth a try where some components are to be chosen: of equals the first is to be
  /// taken. Null: it is the only one.
  std::vector<Way> (*ways)(const Scene&, const AutomaticSettings&, const Way& given) = nullptr;
  /// The noise of its photons falls as this power of the radii that they are gathered within. Null: it has none.
  double (*power_of_noise)(const RenderSettings&) = nullptr;
};
const IntegratorInfo& info_of(Integrator integrator);

/// Makes pass number `pass` ready; the scene must live longer than what is returned.
RaysOfPass rays_of_pass(const Scene& scene, const RenderSettings& settings, int pass);

}  // namespace vpm
