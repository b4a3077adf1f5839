// What renders and vpm info print: where outputs are, what a file holds, warnings; and how bright previews are.
#include <cmath>

#include "tools/plume.h"
#include "vpm/image/exr.h"
#include "vpm/image/png.h"

namespace vpm {
namespace {

using Json = nlohmann::json;

TEST_F(VpmRender, ProgressIsSilentUnlessATerminalWatchesOrItIsAskedFor) {
  const auto errors = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "scene.toml", "-o", "a.exr"});
    return vpm_succeeds(options).err;
  };
  EXPECT_EQ(errors({}), "");
  EXPECT_EQ(errors({"--progress", "auto"}), "");
  EXPECT_EQ(errors({"--progress", "never"}), "");
  EXPECT_NE(errors({"--progress", "always"}).find("100 %"), std::string::npos);
}

TEST_F(VpmRender, SaysWhereTheOutputsAre) {
  const std::string out = vpm_succeeds({"render", "scene.toml", "-o", "a.exr"}).out;
  for (const char* word : {"a.exr", "a.png", "a.json", "2 passes"}) EXPECT_NE(out.find(word), std::string::npos) << out;
}

TEST_F(VpmRender, InfoTellsWhatFilesHold) {
  expect_words(
      vpm_succeeds({"info", "scene.toml"}).out,
      {"renders 2 passes, in each 10000 photons\n", "radii of the first pass: 0.1 m in smoke, 0.1 m on surfaces",
       "40 x 24 pixels", "medium smoke: grid", "sigma_t 30 1/m", "mean free path", "around everything: vacuum",
       "light 0, lamp: spot, power 10 W", "runs volume photon map", "runs surface photon map",
       "other stages: --all lists which and why", "coefficients differ between channels"});
  EXPECT_EQ(vpm_succeeds({"info", "scene.toml"}).out.find("skips shadow rays"), std::string::npos);
  expect_words(vpm_succeeds({"info", "scene.toml", "--all"}).out,
               {"runs volume photon map", "skips shadow rays in media"});
  expect_words(vpm_succeeds({"info", "scene.toml", "--set", "media.smoke.albedo=0.5", "--set",
                             "integrator.single_scattering.type=shadow-rays", "--set",
                             "integrator.transmittance.type=jackknife"})
                   .out,
               {"all coefficients are grey", "runs shadow rays in media, transmittance by jackknife (biased; "});
  expect_words(vpm_succeeds({"info", "smoke.vdb"}).out,
               {"grid density: float, fog volume", "voxel size", "active voxels", "world box", "mean", "memory"});
  expect_words(vpm_succeeds({"info", "smoke.vdb", "--all"}).out, {"background 0", "index box", "translation"});
  expect_words(vpm_succeeds({"info", "scene.toml", "--set", "render.seconds=20", "--set", "render.error=0.01", "--set",
                             "integrator.photons.emitted=auto", "--set", "integrator.photons.stored=500"})
                   .out,
               {"renders passes until 20 s are over or the relative MSE is 0.01, in each",
                "vpm render chooses integrator.photons.emitted, which are"});
  expect_words(vpm_succeeds({"info", "scene.toml", "--set", "integrator.type=path"}).out,
               {"renders 2 passes, in each 1 path a pixel"});
  expect_words(vpm_succeeds({"info", "scene.toml"}).out, {"maps of a pass: about "});
  vpm_refuses({"info", "scene.toml", "--set", "integrator.photons.emitted=1e12"},
              {"integrator.photons.emitted: the maps of a pass would"});
  vpm_refuses({"info", "missing.vdb"}, {"missing.vdb"});
  vpm_refuses({"info", "missing.toml"}, {"missing.toml"});
  vpm_refuses({"info", "smoke.bin"}, {"smoke.bin"});
  vpm_refuses({"info"}, {"file"});
}

TEST_F(VpmRender, InfoRefusesWhatRenderRefuses) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> all{
      {{"integrator.volume.kernel=order-4", "integrator.surface.kernel=order-4", "integrator.radii=per-pixel"}, ""},
      {{"integrator.photons.emitted=0"}, "make one of them positive"},
      {{"integrator.transmittance.type=ratio", "integrator.direct.type=photons"}, "write type = \"shadow-rays\""},
      {{"integrator.distance.type=homogeneous"}, "for grids: "},
      {{"integrator.volume.count=7"}, ""},
      {{"media.smoke.grid=fog"}, "the file holds: density"},
      {{"shapes.0.inside=smoke"}, ""}};
  for (const auto& [settings, mend] : all) {
    std::vector<std::string> info{"info", "scene.toml"}, render{"render", "scene.toml"};
    for (std::vector<std::string>* command : {&info, &render})
      for (const std::string& setting : settings) {
        command->push_back("--set");
        command->push_back(setting);
      }
    const ProcessResult refused = vpm(render);
    EXPECT_EQ(refused.status, 2);
    expect_words(refused.err, {mend});
    vpm_refuses(info, {refused.err});
  }
}

TEST_F(VpmRender, ThePreviewIsExposedAsAskedFor) {
  const auto preview = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"render", "scene.toml", "-o", "a.exr"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    vpm_succeeds(arguments);
    return read_png(path("a.png"), PngValues::srgb);
  };
  const Image dark = preview({"--exposure", "-1"}), bright = preview({"--exposure", "1.5"});
  const Image picture = read_exr(path("a.exr"));
  size_t lit = 0;
  for (size_t i = 0; i < picture.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      // Half a step of the curve, where it is steepest in linear values.
      EXPECT_NEAR(bright.pixels[i][c], std::min(1.0f, std::exp2(1.5f) * picture.pixels[i][c]), 0.005f);
      EXPECT_NEAR(dark.pixels[i][c], std::min(1.0f, 0.5f * picture.pixels[i][c]), 0.005f);
      lit += bright.pixels[i][c] > 0.1f;
    }
  EXPECT_GT(lit, 10u);
  EXPECT_FALSE(same_pixels(preview({}), bright));
  for (const char* stops : {"nan", "inf", "-101", "1e3", "bright", "1 stop", ""})
    vpm_refuses({"render", "scene.toml", "--exposure", stops}, {"--exposure"});
  vpm_succeeds({"bake", "scene.toml", "--set", "shapes.0.name=floor", "--mesh", "floor", "--resolution", "8", "-o",
                "b.exr", "--exposure", "-20"});
  EXPECT_EQ(sum(read_png(path("b.png"), PngValues::srgb)), 0.0);
}

/// The warnings of a render of the scene with these settings: of few pixels, whose rays take thousands of steps where
/// radii are tiny.
class VpmWarnings : public VpmRender {
 protected:
  std::string warnings(const std::vector<std::string>& settings) const {
    std::vector<std::string> arguments{"render", "scene.toml",   "-o",    "a.exr",
                                       "--set",  "film.width=8", "--set", "film.height=6"};
    for (const std::string& setting : settings) {
      arguments.push_back("--set");
      arguments.push_back(setting);
    }
    return vpm_succeeds(arguments).err;
  }
};

TEST_F(VpmWarnings, PhotonsThatNoGatherFindsAreToldOf) {
  for (const char* gather : {"radius", "beam", "nearest"})
    expect_words(warnings({"integrator.volume.radius=1e-9", "integrator.volume.type=" + std::string(gather)}),
                 {"photons in media: a larger integrator.volume.radius ("});
  expect_words(warnings({"integrator.volume.radius=1e-9", "integrator.volume.form=density-at-photon"}),
               {"no gather found any of the "});
  for (const char* gather : {"beams-points", "photon-beams"})
    expect_words(warnings({"integrator.volume.radius=1e-9", "integrator.volume.type=" + std::string(gather)}),
                 {"photon beams: a larger integrator.volume.radius ("});
  const std::string surfaces = warnings({"integrator.surface.radius=1e-9"});
  expect_words(surfaces, {"photons on surfaces: a larger integrator.surface.radius ("});
  EXPECT_EQ(surfaces.find("in media"), std::string::npos) << surfaces;
}

TEST_F(VpmWarnings, CountsThatTheLargestRadiusDecidesAreToldOf) {
  const std::string word = "of the gathers by count met fewer photons than the count of [integrator.volume] within";
  expect_words(
      warnings({"integrator.volume.type=nearest", "integrator.volume.count=5000", "integrator.volume.radius=0.05"}),
      {word});
  EXPECT_EQ(warnings({"integrator.volume.type=nearest", "integrator.volume.count=5", "integrator.volume.radius=10"})
                .find(word),
            std::string::npos);
  // Those of surfaces are few beside those of media.
  const std::string both =
      warnings({"integrator.volume.type=nearest", "integrator.volume.count=5", "integrator.volume.radius=10",
                "integrator.surface.type=nearest", "integrator.surface.count=5000", "integrator.surface.radius=0.05"});
  expect_words(both, {"than the count of [integrator.surface] within"});
  EXPECT_EQ(both.find(word), std::string::npos) << both;
}

TEST_F(VpmWarnings, PlanesAloneHaveInfiniteVariance) {
  const std::string planes = "integrator.volume.type=photon-planes", word = "infinite variance";
  expect_words(warnings({planes, "integrator.volume.share=alone"}), {word});
  EXPECT_EQ(warnings({planes}).find(word), std::string::npos);
}

TEST_F(VpmWarnings, DensitiesAboveTheMajorantAreCounted) {
  expect_words(warnings({"integrator.distance.type=progressive-null"}), {" densities were larger than the majorant"});
}

TEST_F(VpmWarnings, EmptyMapsAreToldOfWhereThePictureIsMadeOfThem) {
  const std::vector<std::string> aside{"lights.lamp.target=[1, 9, 1]"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), aside.begin(), aside.end());
    return warnings(more);
  };
  expect_words(with({"integrator.direct.type=photons"}),
               {"the volume photon map is empty", "the surface photon map is empty"});
  expect_words(with({"integrator.volume.type=beams-points"}), {"there are no photon beams"});
  const auto warns_of_black_alone = [&](const std::vector<std::string>& more) {
    const std::string told = with(more);
    expect_words(told, {"the picture is black: no light was found"});
    EXPECT_EQ(told.find("map is empty"), std::string::npos) << told;
  };
  warns_of_black_alone({"integrator.single_scattering.type=shadow-rays"});
  warns_of_black_alone({"integrator.single_scattering.type=equiangular"});
  // The camera sees no surface.
  warns_of_black_alone(
      {"integrator.single_scattering.type=equiangular", "integrator.direct.type=photons", "camera.target=[0, 9, 2.4]"});
}

}  // namespace
}  // namespace vpm
