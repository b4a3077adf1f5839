// The descriptions of settings: each reaches the member it names and no other, and its values survive being written.
#include "vpm/integrators/describe.h"
#include "vpm/integrators/every_setting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
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

/// The settings that some components have, chosen as the words say.
RenderSettings chosen(const std::vector<std::pair<std::string, std::string>>& words) {
  RenderSettings settings;
  for (const auto& [key, word] : words) {
    const std::optional<Setting> setting = find_setting(settings, key);
    EXPECT_TRUE(setting) << key;
    setting->set(*parse(*setting, word));
  }
  return settings;
}

/// Choices under which all settings are described at least once.
std::vector<RenderSettings> all_choices() {
  std::vector<RenderSettings> all;
  for (const std::string gather : {"radius", "nearest", "beam", "photon-planes", "beams-points"})
    all.push_back(chosen({{"integrator.volume.type", gather},
                          {"integrator.importance.importons", "7"},
                          {"integrator.single_scattering.type", "equiangular"},
                          {"integrator.surface.type", "nearest"},
                          {"integrator.indirect.type", "final-gather"},
                          {"integrator.caustics.type", "nearest"}}));
  for (const StrategyInfo& info : distance_strategies())
    all.push_back(chosen({{"integrator.type", "path"}, {"integrator.distance.type", std::string(info.name)}}));
  for (const EstimatorInfo& info : transmittance_estimators())
    all.push_back(chosen({{"integrator.type", "path"}, {"integrator.transmittance.type", std::string(info.name)}}));
  all.push_back(chosen({{"integrator.type", "combined"}}));
  return all;
}

TEST(Setting, HasAKeyOfItsOwn) {
  for (RenderSettings settings : all_choices()) {
    std::set<std::string> keys;
    std::vector<std::string> tables;
    for (const Setting& setting : describe(settings)) {
      EXPECT_EQ(setting.table() + "." + setting.name(), setting.key);
      EXPECT_TRUE(keys.insert(setting.key).second) << setting.key;
      EXPECT_FALSE(setting.meaning.empty()) << setting.key;
      if (tables.empty() || tables.back() != setting.table()) tables.push_back(setting.table());
    }
    EXPECT_EQ(std::set<std::string>(tables.begin(), tables.end()).size(), tables.size()) << "a table in parts";
  }
}

struct Any {
  template <class T>
  operator T() const;
};
template <class T, size_t... I>
constexpr bool has_so_many(std::index_sequence<I...>) {
  return requires { T{((void)I, Any{})...}; };
}
/// How many members and bases an aggregate has.
template <class T, size_t N = 64>
constexpr size_t members() {
  if constexpr (has_so_many<T>(std::make_index_sequence<N>()))
    return N;
  else
    return members<T, N - 1>();
}

/// A member that is added to the settings must be described.
TEST(Setting, IsEveryMemberOfTheSettings) {
  // Less the base and twelve structures of components; the maker of a piece knows its first pass.
  constexpr size_t kOwn = members<RenderSettings>() - 13 + members<PassSettings>(),
                   kOfPhotons = members<PhotonSettings>(),
                   kOfLight =
                       members<SingleScatteringSettings>() + members<DirectSettings>() + members<IndirectSettings>(),
                   kOfStopRule = members<StopRule>() - 1, kOfGuide = members<GuideSettings>(),
                   kOfCombined = members<CombinedSettings>();
  constexpr size_t kOfVolume = 11;                           // and `count` stands for two members
  constexpr size_t kOfSurface = members<AskedGather>() - 1;  // without beam_count
  constexpr size_t kOfCaustics = kOfSurface - 1 + 1;         // the boundary is the surface's; and emitted
  size_t numbers = 2;                                        // the types of distance and transmittance
  for (const StrategyInfo& info : distance_strategies()) numbers += info.parameters.size();
  for (const EstimatorInfo& info : transmittance_estimators()) numbers += info.parameters.size();
  constexpr size_t kSameName = 3;  // step and majorant of two strategies, step of two estimators
  std::set<std::string> keys;
  for (RenderSettings settings : all_choices())
    for (const Setting& setting : describe(settings)) keys.insert(setting.key);
  EXPECT_EQ(keys.size(), kOwn + kOfPhotons + kOfLight + kOfStopRule + kOfGuide + kOfCombined + kOfVolume + kOfSurface +
                             kOfCaustics + numbers - kSameName);
}

TEST(Setting, ReachesItsMemberAndNoOther) {
  for (const RenderSettings& usual : all_choices()) {
    RenderSettings described = usual;
    for (const Setting& setting : describe(described))
      for (const SettingValue& value : other_values(setting, setting.get())) {
        RenderSettings s = usual;
        find_setting(s, setting.key)->set(value);
        EXPECT_EQ(find_setting(s, setting.key)->get(), value) << setting.key;
        RenderSettings untouched = usual;
        for (const Setting& before : describe(untouched))
          if (const std::optional<Setting> after = find_setting(s, before.key);
              after && after->default_value == before.default_value && before.key != setting.key) {
            EXPECT_EQ(after->get(), before.get()) << setting.key << " changes " << before.key;
          }
      }
  }
}

TEST(Setting, IsTheMemberThatItsKeyNames) {
  RenderSettings s = chosen({{"integrator.surface.type", "nearest"}, {"integrator.surface.count", "17"}});
  EXPECT_EQ(s.surface.count, 17u);
  s = chosen({{"integrator.volume.type", "beam"}, {"integrator.volume.count", "18"}});
  EXPECT_EQ(s.volume.beam_count, 18u);
  EXPECT_EQ(s.volume.count, GatherSettings{}.count);
  s = chosen({{"integrator.surface.boundary", "corrected"}});
  EXPECT_EQ(s.surface.boundary, BoundaryRule::corrected);
  s = chosen({{"integrator.distance.type", "ray-march"}, {"integrator.distance.step", "0.3"}});
  EXPECT_EQ(s.distance.parameters, (Parameters{{"step", 0.3f}}));
  EXPECT_FALSE(find_setting(s, "film.width"));
  EXPECT_EQ(find_setting(s, "render.layers")->get(), SettingValue(std::string("none")));
  s = chosen({{"render.layers", "samples+depth"}});
  EXPECT_TRUE(s.layers.has(ViewLayer::depth) && s.layers.has(ViewLayer::samples) && !s.layers.has(ViewLayer::normal));
}

TEST(Setting, IsOfTheChosenComponents) {
  const auto has = [](const std::vector<std::pair<std::string, std::string>>& words, const char* key) {
    RenderSettings s = chosen(words);
    return find_setting(s, key).has_value();
  };
  EXPECT_FALSE(has({}, "integrator.volume.count"));
  EXPECT_TRUE(has({{"integrator.volume.type", "nearest"}}, "integrator.volume.count"));
  EXPECT_FALSE(has({{"integrator.type", "path"}}, "integrator.volume.radius"));
  EXPECT_FALSE(has({{"integrator.type", "combined"}}, "integrator.transmittance.type"));
  EXPECT_FALSE(has({}, "integrator.importance.aim"));
  EXPECT_FALSE(has({{"integrator.distance.type", "mean-extinction"}}, "integrator.volume.density_floor"));
  EXPECT_FALSE(has({{"integrator.type", "path"}}, "integrator.techniques"));
  EXPECT_TRUE(has({{"integrator.type", "combined"}}, "integrator.techniques"));
}

TEST(Setting, IsReadAgainFromItsText) {
  for (RenderSettings settings : all_choices())
    for (const Setting& setting : describe(settings)) {
      for (const SettingValue& value : other_values(setting, setting.default_value))
        EXPECT_EQ(parse(setting, text_of(value)), value) << setting.key << " = " << text_of(value);
      for (const char* text : {"", "-1", "1e99", "nan", "inf", "12 m", "auto", "perhaps"})
        EXPECT_FALSE(parse(setting, text)) << setting.key << " = " << text;
    }
  RenderSettings s;
  EXPECT_EQ(parse(*find_setting(s, "integrator.volume.radius"), "0.0123"), SettingValue(0.0123f));
  EXPECT_FALSE(parse(*find_setting(s, "integrator.volume.radius"), "0"));
  EXPECT_FALSE(parse(*find_setting(s, "integrator.volume.density_floor"), "1.5"));
  EXPECT_FALSE(parse(*find_setting(s, "render.passes"), "0"));
}

TEST(Setting, OfWhatPassesEstimateIsTold) {
  RenderSettings s;
  s.until.passes = 3;
  s.seed = 4;
  s.volume.radius = 0.1f;
  const std::string line = settings_line(s);
  EXPECT_EQ(field_of(line, "integrator.volume.radius"), "0.1");
  EXPECT_EQ(field_of(line, "integrator.type"), "photon-map");
  EXPECT_EQ(field_of(line, "integrator.importance.importons"), "0");
  for (const char* key : {"render.passes", "render.seed", "integrator.volume.count", "radius", "integrator.volume"})
    EXPECT_FALSE(field_of(line, key)) << key;
  s.volume.choose("nearest");
  EXPECT_EQ(field_of(settings_line(s), "integrator.volume.count"), "50");
  EXPECT_EQ(field_of("a=1 bb=2=3 c=", "bb"), "2=3");
  EXPECT_EQ(field_of("a=1 bb=2=3 c=", "c"), "");
  EXPECT_FALSE(field_of("a=1 bb=2=3 c=", "b"));
}

TEST(Setting, OfSomeComponentsSaysOfWhich) {
  const auto with = [](const std::string& key) {
    std::string all;
    for (const SettingOfSome& each : every_setting())
      if (each.setting.key == key)
        all += fmt::format("[{}: {}]", fmt::join(each.integrators, ", "), fmt::join(each.with, "; "));
    return all;
  };
  EXPECT_EQ(with("render.passes"), "[: ]");
  EXPECT_EQ(with("integrator.type"), "[: ]");
  EXPECT_EQ(with("integrator.importance.aim"), "[photon-map: `importons` > 0]");
  EXPECT_EQ(with("integrator.volume.length"),
            "[photon-map: `type` = `\"photon-beams\"`, `\"photon-planes\"`, `\"beams-points\"`]");
  EXPECT_EQ(with("integrator.distance.optical_step"), "[photon-map, path: `type` = `\"ray-march-adaptive\"`]");
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
