// A render of a ball of fog that has all that a report tells: errors, layers of techniques, choices, a warning.
#pragma once

#include "tools/ball_of_fog.h"
#include "tools/browser.h"

namespace vpm {

class RenderedFog : public BrowsedPage {
 protected:
  static constexpr int kWidth = 24, kHeight = 8;  // pixels

  RenderedFog() {
    write("fog.toml", "# </script>\n" + ball_of_fog(kWidth, kHeight));
    made_once({"fog.exr", "fog.json", "fog.png"}, [&] {
      vpm_succeeds({"render", "fog.toml", "-o", "fog.exr", "--passes", "9", "--set", "integrator.type=combined",
                    "--set", "integrator.volume.radius=auto", "--set", "camera.position=[0, 0, 2.5]", "--set",
                    "render.max_events=3", "--set", "integrator.photons.emitted=500", "--layers", "combined"});
    });
  }
};

}  // namespace vpm
