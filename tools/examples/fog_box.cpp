// A scene built in code: a box of fog on a floor, with a light above it, rendered to an EXR file: fog_box FILE.exr
#include <cstdio>

#include "vpm/base/error.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/picture.h"
#include "vpm/job/render_job.h"
#include "vpm/render/render.h"

namespace {

vpm::SceneParts fog_in_a_box() {
  vpm::Medium fog;
  fog.sigma_t = vpm::Rgb(1.0f);  // 1/m
  fog.sigma_s = vpm::Rgb(0.9f);
  fog.phase = vpm::HenyeyGreenstein{0.5f};
  const vpm::Interface fog_inside{.inside = 0};  // the first of the media; outside is vacuum

  vpm::SceneParts parts;
  parts.media = {{fog}};
  parts.materials = {{vpm::Boundary{}}, {vpm::Lambertian{vpm::Rgb(0.6f, 0.5f, 0.4f)}}};
  parts.shapes = {{.surface = vpm::box_mesh({-1.0, 0.01, -1.0}, {1.0, 2.01, 1.0}), .material = 0, .media = fog_inside},
                  {.surface = vpm::quad_mesh({-4.0, 0.0, 4.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, -8.0}), .material = 1}};
  parts.lights = {{"light", vpm::PointLight{vpm::Vec3(0.5f, 4.0f, 1.0f), vpm::Rgb(30.0f)}}};  // m, W/sr
  parts.camera = vpm::make_camera({1.0f, 2.5f, 6.0f}, {0.0f, 0.8f, 0.0f}, {0.0f, 1.0f, 0.0f}, 40.0f, {256, 192});
  return parts;
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 2) throw vpm::InputError("usage: fog_box FILE.exr");
  vpm::RenderSettings settings;
  settings.until.passes = 16;                               // of 200,000 photons each, the default
  settings.volume.radius = settings.surface.radius = 0.1f;  // m, of the first pass
  const vpm::RenderJob job = make_job(assemble(fog_in_a_box()), settings);
  const vpm::RenderResult result = render(job.scene, job.settings, vpm::nothing_rendered(job.scene.camera),
                                          {.progress = vpm::ProgressMode::automatic});
  write_picture(arguments[1], job, result);
} catch (const vpm::InputError& error) {
  std::fprintf(stderr, "fog_box: %s\n", error.what());
  return 2;
}
