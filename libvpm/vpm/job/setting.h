// A setting is declared once: its declaration is what reads, prints, checks, chooses and describes it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vpm/base/range.h"
#include "vpm/render/settings.h"

namespace vpm {

/// The word for a value that the render chooses.
inline constexpr const char* kAuto = "auto";

/// The largest value of render.passes: more than will be rendered.
inline constexpr int kMostPasses = 1'000'000'000;

/// What a setting holds. A word stands for an enumerator, or is the name of a strategy or an estimator.
using SettingValue = std::variant<bool, uint64_t, float, double, std::string>;
/// As scene files and --set take it, to the last bit.
std::string text_of(const SettingValue& value);

/// What a setting may hold.
struct Flags {};
struct Integers {
  uint64_t lo = 0, hi = 0;  // both allowed
};
struct Numbers {
  Range range = kAny;  // finite numbers besides
};
struct Words {
  std::vector<std::string> words;
};
/// Some of these words, one at least: "a+b" in their order.
struct WordSet {
  std::vector<std::string> words;
};
using Domain = std::variant<Flags, Integers, Numbers, Words, WordSet>;

/// The words of the value of a WordSet.
std::vector<std::string> words_in(const std::string& value);

/// Where a setting stands in RenderSettings. `set` expects a value of the setting's domain; a number of either
/// precision serves for both.
struct Member {
  SettingValue (*get)(const RenderSettings&) = nullptr;
  void (*set)(RenderSettings&, const SettingValue&) = nullptr;
};

/// What must be so for a setting to have a meaning. Where it is not, a scene file must not give the setting, and its
/// value is the default. Always so without `met`.
struct Need {
  bool (*met)(const RenderSettings&) = nullptr;
  std::string (*wrong)(const RenderSettings&) = nullptr;  // what is not so
  std::string_view right = "";                            // what would be right
};

/// What decides where a setting is left out: others, which are read before it.
struct DecidedBy {
  std::string_view key = "";  // one that leaves nothing to be chosen here where a file gives it; "": none does
  SettingValue (*value)(const RenderSettings&) = nullptr;
  std::string_view chosen_with = "";  // one with which this is chosen, too, where it is kAuto; "": with none
};

/// Does a setting keep its default where kAuto is made of what a file leaves out?
struct LeftOutStays {
  bool stays = false;
  std::string_view unless_key = "", unless_word = "";  // it does not where the file says this of another setting
};

struct Setting {
  std::string key;                             // of scene files: "volume.radius"
  Member member;                               // its default is that of RenderSettings, or decided_by
  Domain domain;                               // besides the default, which is always allowed
  std::string meaning;                         // one line of Markdown for scenes/README.md
  std::string_view unit = "";                  // "": none
  std::string_view default_text = "";          // for people, where the default's value says little
  bool automatic = false;                      // may it be kAuto?
  bool usually_chosen = false;                 // is its default chosen, see choose_default_radii()?
  LeftOutStays left_out = {};                  // of those that may be kAuto
  bool of_passes = false;                      // does it say which passes are rendered, not what each estimates?
  Need need = {};                              // by default none
  DecidedBy decided_by = {};                   // by default nothing but itself
  std::vector<std::string_view> stands_for{};  // keys that it sets together, in whose place it is given

  /// "volume" and "radius" of "volume.radius".
  std::string section() const { return key.substr(0, key.find('.')); }
  std::string name() const { return key.substr(key.find('.') + 1); }
  bool needed(const RenderSettings& settings) const { return !need.met || need.met(settings); }
};

/// All, section by section, in the order in which they are read: a need or a decision comes before what goes by it. A
/// key may be declared several times, with needs of which one is met at the most.
std::span<const Setting> all_settings();
/// The declaration of the key whose need is met; null where there is none.
const Setting* find_setting(std::string_view key, const RenderSettings& settings);

/// What is wrong with a value: "must be in [0, 1], not 2"; "" where it is of the domain.
std::string outside_of(const Domain& domain, const SettingValue& value);
/// The value that such a text is in this setting; nothing where it is none of its domain.
std::optional<SettingValue> parse(const Setting& setting, const std::string& text);

/// A setting and its value.
struct Field {
  std::string key;
  SettingValue value;
};
/// The settings that decide what passes estimate, except those whose need is not met.
std::vector<Field> estimate_fields(const RenderSettings& settings);
/// These as one line, "key=value key=value", of which field_of() finds each.
std::string settings_line(const RenderSettings& settings);
/// The value of a key in words "key=value"; nothing where it is missing.
std::optional<std::string> field_of(std::string_view line, std::string_view key);

}  // namespace vpm
