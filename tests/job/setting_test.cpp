// The declarations of settings: each reaches the member it names and no other, and its values survive being written.
#include "vpm/job/setting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "vpm/job/settings_table.h"

namespace vpm {
namespace {

/// Values of the setting's domain other than the one it has, its ends among them.
std::vector<SettingValue> other_values(const Setting& setting, const SettingValue& present) {
  std::vector<SettingValue> values;
  if (std::holds_alternative<Flags>(setting.domain)) values = {true, false};
  if (const auto* of = std::get_if<Integers>(&setting.domain)) values = {of->lo, of->lo + 1, of->hi};
  if (const auto* of = std::get_if<Numbers>(&setting.domain)) {
    const auto held = [&](float number) {
      return std::holds_alternative<float>(present) ? SettingValue(number) : SettingValue(static_cast<double>(number));
    };
    values.push_back(held(0.1f));
    if (!of->range.lo_open) values.push_back(held(static_cast<float>(of->range.lo)));
    if (!of->range.hi_open) values.push_back(held(static_cast<float>(of->range.hi)));
  }
  if (const auto* of = std::get_if<Words>(&setting.domain)) values.assign(of->words.begin(), of->words.end());
  if (const auto* of = std::get_if<WordSet>(&setting.domain)) {
    values.assign(of->words.begin(), of->words.end());
    values.emplace_back(of->words.front() + "+" + of->words.back());
  }
  std::erase(values, present);
  return values;
}

/// Of all members that are declared, by number of the declaration.
std::vector<SettingValue> members(const RenderSettings& settings) {
  std::vector<SettingValue> values;
  for (const Setting& setting : all_settings()) values.push_back(setting.member.get(settings));
  return values;
}

TEST(Setting, HasAKeyOfItsOwnOrOfNeedsThatExcludeEachOther) {
  std::map<std::string, int> declared;
  std::vector<std::string> sections;
  for (const Setting& setting : all_settings()) {
    EXPECT_EQ(setting.section() + "." + setting.name(), setting.key);
    EXPECT_EQ(setting.name().find('.'), std::string::npos);
    EXPECT_TRUE(++declared[setting.key] == 1 || setting.need.met) << setting.key;
    if (sections.empty() || sections.back() != setting.section()) sections.push_back(setting.section());
  }
  EXPECT_EQ(std::set<std::string>(sections.begin(), sections.end()).size(), sections.size()) << "a section in parts";
  for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest, GatherMode::beam, GatherMode::photon_beams,
                                GatherMode::photon_planes, GatherMode::beams_points}) {
    RenderSettings s;
    s.volume.mode = mode;
    const auto all = all_settings();
    const auto count = std::count_if(all.begin(), all.end(),
                                     [&](const Setting& each) { return each.key == "volume.count" && each.needed(s); });
    EXPECT_EQ(count, mode == GatherMode::nearest || mode == GatherMode::beam ? 1 : 0);
  }
}

/// A member that is added to the settings does not compile here until it is named, and counted: then it is declared.
TEST(Setting, IsEveryMemberOfTheSettings) {
  const RenderSettings s;
  const auto& [integrator, seed, until, samples, view, emitted, stored, block, sequence, in_cube, flights, planes,
               max_events, guide, combined, distance, transmittance, volume, surface, caustics, aimed, radii, form,
               floor, volume_direct, beam_length, plane_use, direct_samples, surface_direct, surface_samples, indirect,
               gather_rays, gather_by, irradiance, step] = s;
  [[maybe_unused]] const auto& [passes, first, seconds, error] = until;
  [[maybe_unused]] const auto& [importons, aim, split, scatter] = guide;
  [[maybe_unused]] const auto& [techniques, heuristic, layers] = combined;
  [[maybe_unused]] const auto& [strategy, length, optical, majorant, extinction] = distance;
  [[maybe_unused]] const auto& [estimator, march, comb] = transmittance;
  [[maybe_unused]] const auto& [mode, radius, count, kernel, boundary, beam_count] = volume;
  constexpr size_t kOwn = 35 - 8, kOfStopRule = 4, kOfGuide = 4, kOfCombined = 3, kOfDistance = 5, kOfTransmittance = 3,
                   kOfGather = 6;
  constexpr size_t kUndeclared = 4;  // surface.beam_count, caustics.beam_count, and caustics.boundary, the surface's;
                                     // the first pass, which the maker of a piece tells
  constexpr size_t kCombined = 1;    // surface.method
  EXPECT_EQ(all_settings().size(), kOwn + kOfStopRule + kOfGuide + kOfCombined + kOfDistance + kOfTransmittance +
                                       3 * kOfGather - kUndeclared + kCombined);
}

TEST(Setting, ReachesItsMemberAndNoOther) {
  const RenderSettings usual;
  for (const Setting& setting : all_settings()) {
    if (!setting.stands_for.empty()) continue;
    for (const SettingValue& value : other_values(setting, setting.member.get(usual))) {
      RenderSettings s;
      setting.member.set(s, value);
      EXPECT_EQ(setting.member.get(s), value) << setting.key;
      const std::vector<SettingValue> before = members(usual), after = members(s);
      for (size_t i = 0; i < after.size(); ++i) {
        const Setting& each = all_settings()[i];
        const bool combines =
            std::find(each.stands_for.begin(), each.stands_for.end(), setting.key) != each.stands_for.end();
        if (&each == &setting || combines) continue;
        EXPECT_EQ(after[i], before[i]) << setting.key << " changes " << each.key;
      }
    }
  }
}

TEST(Setting, IsTheMemberThatItsKeyNames) {
  RenderSettings s;
  const auto set = [&](const std::string& key, const std::string& text) {
    const Setting* const setting = find_setting(key, s);
    ASSERT_TRUE(setting) << key;
    setting->member.set(s, *parse(*setting, text));
  };
  set("surface.gather", "nearest");
  set("surface.count", "17");
  EXPECT_EQ(s.surface.count, 17u);
  set("volume.gather", "beam");
  set("volume.count", "18");
  EXPECT_EQ(s.volume.beam_count, 18u);
  EXPECT_EQ(s.volume.count, GatherSettings{}.count);
  set("surface.boundary", "corrected");
  EXPECT_EQ(s.caustics.boundary, BoundaryRule::corrected);  // goes with the surface's
  set("surface.method", "final-gather");
  EXPECT_EQ(s.surface_direct, DirectLight::shadow_rays);
  EXPECT_EQ(s.surface_indirect, IndirectLight::final_gather);
  s.surface_direct = DirectLight::photons;
  EXPECT_EQ(find_setting("surface.method", s)->member.get(s), SettingValue(std::string()));  // a pair without a name
  EXPECT_FALSE(find_setting("film.width", s));
  EXPECT_EQ(find_setting("render.layers", s)->member.get(s), SettingValue(std::string("none")));
  set("render.layers", "samples+depth");
  EXPECT_TRUE(s.layers.has(ViewLayer::depth) && s.layers.has(ViewLayer::samples) && !s.layers.has(ViewLayer::normal));
}

TEST(Setting, IsReadAgainFromItsText) {
  for (const Setting& setting : all_settings()) {
    const SettingValue usual = setting.member.get({});
    for (const SettingValue& value : other_values(setting, usual))
      EXPECT_EQ(parse(setting, text_of(value)), value) << setting.key << " = " << text_of(value);
    for (const char* text : {"", "-1", "1e99", "nan", "inf", "12 m", "auto", "perhaps"})
      EXPECT_FALSE(parse(setting, text)) << setting.key << " = " << text;
  }
  EXPECT_EQ(parse(*find_setting("volume.radius", {}), "0.0123"), SettingValue(0.0123f));
  EXPECT_FALSE(parse(*find_setting("volume.radius", {}), "0"));
  EXPECT_FALSE(parse(*find_setting("volume.density_floor", {}), "1.5"));
  EXPECT_FALSE(parse(*find_setting("render.passes", {}), "0"));
}

TEST(Setting, OfWhatPassesEstimateIsTold) {
  RenderSettings s;
  s.until.passes = 3;
  s.seed = 4;
  s.volume.radius = 0.1f;
  const std::string line = settings_line(s);
  EXPECT_EQ(field_of(line, "volume.radius"), "0.1");
  EXPECT_EQ(field_of(line, "render.integrator"), "photon");
  EXPECT_EQ(field_of(line, "importance.aim"), "true");
  for (const char* key : {"render.passes", "render.seed", "surface.method", "volume.count", "radius", "volume"})
    EXPECT_FALSE(field_of(line, key)) << key;
  s.volume.mode = GatherMode::nearest;
  EXPECT_EQ(field_of(settings_line(s), "volume.count"), "50");
  EXPECT_EQ(field_of("a=1 bb=2=3 c=", "bb"), "2=3");
  EXPECT_EQ(field_of("a=1 bb=2=3 c=", "c"), "");
  EXPECT_FALSE(field_of("a=1 bb=2=3 c=", "b"));
}

TEST(Setting, IsDescribedInThePageOfScenes) {
  std::ifstream file(std::string(VPM_SOURCE_DIR) + "/scenes/README.md");
  const std::string page(std::istreambuf_iterator<char>(file), {});
  const std::string begin = "a test compares. -->\n", end = "<!-- The end of the table. -->";
  const size_t from = page.find(begin) + begin.size(), to = page.find(end);
  ASSERT_LT(from, to);
  EXPECT_TRUE(page.substr(from, to - from) == settings_table()) << "the table of that page must be:\n"
                                                                << settings_table();
}

}  // namespace
}  // namespace vpm
