// Files with the keys of older versions: rewritten, they say the same, and comments stay where they were.
#include "vpm/input/toml/upgrade.h"

#include <gtest/gtest.h>

#include "input/scene_text.h"
#include "vpm/base/error.h"
#include "vpm/input/toml/old_keys.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/every_setting.h"

namespace vpm {
namespace {

std::string upgraded(const std::string& text) { return upgrade("old.toml", text).text; }

TEST(Upgrade, MovesKeysToTheirTablesWithTheirComments) {
  EXPECT_EQ(upgraded(R"(# A scene.
[camera]
position = [0, 0, 3]

# How.
[render]
passes = 4  # few
# Which.
integrator = "photon"  # not paths

# Photons.
[photons]
# So many.
emitted = 1000  # a pass

# Media.
[volume]
direct = "shadow-rays"  # crisp
gather = "beam"
radius = 0.1

[[lights]]
type = "point"
# The end.
)"),
            R"(# A scene.
[camera]
position = [0, 0, 3]

# How.
[render]
passes = 4  # few

[integrator]
# Which.
type = "photon-map"  # not paths

# Photons.
[integrator.photons]
# So many.
emitted = 1000  # a pass

[integrator.volume]
type = "beam"
radius = 0.1

# Media.
[integrator.single_scattering]
type = "shadow-rays"  # crisp

[[lights]]
type = "point"
# The end.
)");
}

TEST(Upgrade, LeavesOtherFilesAsTheyAre) {
  for (const std::string text : {"", "# nothing\n", "[render]\npasses = 3\n\n# end", "[integrator]\ntype = 'path'\n",
                                 "[[shapes]]\nname = \"[volume]\"\n"})
    EXPECT_EQ(upgraded(text), text);
}

TEST(Upgrade, TakesAMethodApart) {
  EXPECT_EQ(
      upgraded("[surface]\nmethod = 'final-gather'\ngather_rays = 4\n"),
      "[integrator.direct]\ntype = \"shadow-rays\"\n\n[integrator.indirect]\ntype = \"final-gather\"\nrays = 4\n");
  EXPECT_EQ(upgraded("[surface]\nmethod = \"visualise\"\n"),
            "[integrator.direct]\ntype = \"photons\"\n\n[integrator.indirect]\ntype = \"photons\"\n");
}

TEST(Upgrade, SaysWhatComponentsDoNotHave) {
  const Upgraded paths = upgrade("old.toml",
                                 "[render]\nintegrator = 'path'\n[photons]\nemitted = 5\n[distance]\nstep = 2\n"
                                 "strategy = 'ray-march'\n");
  EXPECT_EQ(paths.text,
            "[render]\n\n[integrator]\ntype = 'path'\n\n[integrator.distance]\nstep = 2\ntype = 'ray-march'\n");
  EXPECT_EQ(paths.notes,
            std::vector<std::string>{
                "integrator.photons.emitted is left out, with its comments: the components that the file names do not "
                "have it"});
  EXPECT_EQ(upgrade("old.toml", "[render]\nintegrator = 'auto'\n[photons]\nemitted = 5\n").notes,
            std::vector<std::string>{"integrator.photons.emitted is left out, with its comments: type \"auto\" chooses "
                                     "it, too; name a type to keep it"});
}

TEST(Upgrade, KeepsCommentsBelowAKeyAndHeadlinesWithTheirTable) {
  EXPECT_EQ(upgraded(R"([render]
passes = 2
#passes = 20
radii = "constant"

# --- photons ---

[photons]
emitted = 4000
# flights: all
#flights = 100

[volume]
gather = "beam"
#radius = 0.1
# --- surfaces
[surface]
direct = "shadow-rays"
# the last

# --- camera
[camera]
fov = 40
)"),
            R"([render]
passes = 2
#passes = 20

[integrator]
radii = "constant"

# --- photons ---

[integrator.photons]
emitted = 4000
# flights: all
#flights = 100

[integrator.volume]
type = "beam"
#radius = 0.1

# --- surfaces
[integrator.direct]
type = "shadow-rays"
# the last

# --- camera
[camera]
fov = 40
)");
}

TEST(Upgrade, ReadsValuesOfSeveralLines) {
  EXPECT_EQ(upgraded("[combined]\ntechniques = [\n  'connections',  # lines\n  'light-tracing',\n]\n[render]\n"
                     "integrator = 'combined'\n"),
            "[integrator]\ntechniques = [\n  'connections',  # lines\n  'light-tracing',\n]\ntype = "
            "'combined'\n\n[render]\n");
}

TEST(Upgrade, RewritesExperimentsWhereTheyAre) {
  EXPECT_EQ(upgraded(R"(title = "x"
[set]
photons.emitted = 20_000  # few
film.width = 8
[reference]
set = { render.integrator = "photon", volume.radius = 1 }
[product]
volume.gather = ["beam", "radius"]
[[methods]]
name = "m"
[methods.set]
surface.method = "final-gather"
)"),
            R"(title = "x"
[set]
integrator.photons.emitted = 20_000  # few
film.width = 8
[reference]
set = { integrator.type = "photon-map", integrator.volume.radius = 1 }
[product]
integrator.volume.type = ["beam", "radius"]
[[methods]]
name = "m"
[methods.set]
integrator.direct.type = "shadow-rays"
integrator.indirect.type = "final-gather"
)");
}

TEST(Upgrade, KeepsLineEndsAndByteOrderMarks) {
  EXPECT_EQ(upgraded("[volume]\r\nradius = 1\r\n[film]\r\nwidth = 8\r\n"),
            "[integrator.volume]\r\nradius = 1\r\n\r\n[film]\r\nwidth = 8\r\n");
  EXPECT_EQ(upgraded("\xef\xbb\xbf[volume]\nradius = 1\n"), "\xef\xbb\xbf[integrator.volume]\nradius = 1\n");
}

TEST(Upgrade, ReadsNoCommentsAsValues) {
  EXPECT_EQ(upgraded("[surface]\nmethod = 'progressive'  # or 'final-gather', 'visualise'\n"),
            "[integrator.direct]\n# or 'final-gather', 'visualise'\ntype = \"shadow-rays\"\n\n"
            "[integrator.indirect]\ntype = \"photons\"\n");
  EXPECT_EQ(upgraded("[render]\nintegrator = 'path'  # or 'photon'\n[distance]\nstrategy = 'delta'\n"),
            "[render]\n\n[integrator]\ntype = 'path'  # or 'photon'\n\n[integrator.distance]\ntype = 'delta'\n");
}

TEST(Upgrade, KeepsCommentsOfHeaders) {
  EXPECT_EQ(upgraded("# A\n[photons]  # many\nflights = 3\n# B\n[volume]\ngather = 'photon-beams'\n# C\n[caustics]\n"),
            "# C\n\n# A\n# many\n# B\n[integrator.volume]\nflights = 3\ntype = 'photon-beams'\n");
}

TEST(Upgrade, FindsKeysHoweverTheyAreWritten) {
  EXPECT_EQ(upgraded("[\"volume\"]\n\"radius\" = 1\n"), "[integrator.volume]\nradius = 1\n");
  EXPECT_EQ(upgraded("volume . radius = 1\n"), "[integrator.volume]\nradius = 1\n");
}

TEST(Upgrade, RewritesSettingsOfExperimentsInAnyForm) {
  const std::string methods = "[[methods]]\nname = 'm'\n";
  EXPECT_EQ(upgraded(methods + "set.volume.gather = 'beam'\n"), methods + "set.integrator.volume.type = 'beam'\n");
  EXPECT_EQ(upgraded(methods + "set = { surface.method = \"final-gather\", film.width = 4 }\n"),
            methods +
                "set = { integrator.direct.type = \"shadow-rays\", integrator.indirect.type = \"final-gather\", "
                "film.width = 4 }\n");
  EXPECT_EQ(upgraded("title = \"how volume.radius = 1 acts\"\n" + methods + "set.volume.radius = 2\n"),
            "title = \"how volume.radius = 1 acts\"\n" + methods + "set.integrator.volume.radius = 2\n");
}

/// Nothing comes out that is not TOML, or that still has old keys.
TEST(Upgrade, RefusesWhatStandsWhereItCannotBeRewritten) {
  const std::string methods = "[[methods]]\nname = 'm'\n";
  for (const std::string& text : {std::string("volume = { gather = 'beam' }\n"),
                                  std::string("[integrator]\ntype = 'path'\n[render]\nintegrator = 'path'\n"),
                                  "[product]\nsurface.method = ['progressive', 'final-gather']\n" + methods,
                                  "[set]\nvolume = { gather = 'beam' }\n" + methods})
    EXPECT_THROW(upgraded(text), InputError) << text;
}

TEST(Upgrade, RefusesWhatItCannotRewrite) {
  EXPECT_THROW(upgraded("[volume\n"), InputError);
  EXPECT_THROW(upgraded("[volume]\nnonsense = 1\n"), InputError);
  EXPECT_THROW(upgraded("[[methods]]\nname = 'a'\n[methods.set.volume]\nradius = 1\n"), InputError);
}

/// Every key of today is one that a scene can say, or two.
TEST(Upgrade, KnowsKeysOfToday) {
  const std::vector<SettingOfSome> all = every_setting();
  for (const OldKey& old : old_keys()) {
    if (old.old_key == "surface.method") continue;
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const SettingOfSome& each) {
      return each.setting.key == old.key;
    })) << old.key;
  }
}

TEST(Upgrade, IsReadAsTheOldFileWas) {
  const RenderSettings s =
      load_with(
          upgraded("[media.fog]\ntype = 'homogeneous'\nsigma_s = 1\nsigma_a = 0\n[volume]\ngather = 'photon-planes'\n"
                   "beams = 'long'\nplanes = 'alone'\nradius = 0.2\n[photons]\nplanes = 7\nflights = 9\n"
                   "[transmittance]\nestimator = 'ratio'\n"))
          .settings;
  EXPECT_EQ(s.volume.type(), "photon-planes");
  EXPECT_EQ(s.volume.length, BeamLength::long_beams);
  EXPECT_EQ(s.volume.share, PlaneUse::alone);
  EXPECT_EQ(s.volume.planes, 7u);
  EXPECT_EQ(s.volume.flights, 9u);
  EXPECT_EQ(s.transmittance.estimator, "ratio");
}

}  // namespace
}  // namespace vpm
