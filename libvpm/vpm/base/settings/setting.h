// A setting is described once, by the component that it belongs to: its description is what reads, prints, checks,
// chooses and documents it.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "vpm/base/settings/range.h"

namespace vpm {

/// The word for a value that the render chooses.
inline constexpr const char* kAuto = "auto";

/// What a setting holds. A word stands for an enumerator, or names a component.
using SettingValue = std::variant<bool, uint64_t, float, double, std::string>;
/// As scene files and --set take it, to the last bit.
std::string text_of(const SettingValue& value);

/// What a setting may hold.
struct Flags {};
struct Integers {
  uint64_t lo = 0, hi = std::numeric_limits<uint64_t>::max();  // both allowed; scene files have smaller ones, by TOML
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

/// What is wrong with a value: "must be in [0, 1], not 2"; "" where it is of the domain.
std::string outside_of(const Domain& domain, const SettingValue& value);

/// What a description may say besides.
struct SettingTraits {
  std::string_view unit = "";
  std::string_view default_text = "";  // for people, where the default's value says little
  bool automatic = false;              // may it be "auto", kAuto, so that a render chooses it?
  bool keeps_default = false;          // of those: is it chosen only where "auto" stands, and not where it is left out?
  bool default_chosen = false;         // is the default itself chosen, see choose_default_radii()?
  bool of_passes = false;              // does it say which passes are rendered, not what each estimates?
};

/// A setting of an object, which must outlive it.
struct Setting : SettingTraits {
  std::string key;      // with the tables that it stands in: "integrator.volume.radius"
  std::string meaning;  // one line of Markdown
  Domain domain;        // besides the default, which is always allowed
  SettingValue default_value;
  std::function<SettingValue()> get;
  std::function<void(const SettingValue&)> set;  // a value of the domain; numbers of either precision serve for both

  /// "integrator.volume" and "radius" of "integrator.volume.radius".
  std::string table() const { return key.substr(0, key.rfind('.')); }
  std::string name() const { return key.substr(key.rfind('.') + 1); }
};

/// The value that such a text is in this setting; nothing where it is none of its domain.
std::optional<SettingValue> parse(const Setting& setting, const std::string& text);

/// The words of an enumeration, in the order of its enumerators: specialised beside those that settings hold, with a
/// member `words`.
template <class Enum>
struct WordsOf;

template <class Enum>
std::string word_of(Enum value) {
  return std::string(WordsOf<Enum>::words[static_cast<size_t>(value)]);
}
/// All words of an enumeration, or the first few.
template <class Enum>
Words words_of(size_t count = WordsOf<Enum>::words.size()) {
  return {{WordsOf<Enum>::words.begin(), WordsOf<Enum>::words.begin() + count}};
}
/// The names in a list.
template <class Info>
std::vector<std::string> names_of(std::span<const Info> infos) {
  std::vector<std::string> names;
  for (const Info& info : infos) names.emplace_back(info.name);
  return names;
}

/// A length of which 0 stands for "not given".
template <class T>
concept OptionalLength = requires(const T& length) {
  { length.metres() } -> std::same_as<float>;
  T(0.0f);
};

template <class T>
SettingValue value_of_member(const T& member) {
  if constexpr (std::is_enum_v<T>)
    return word_of(member);
  else if constexpr (std::integral<T> && !std::same_as<T, bool>)
    return static_cast<uint64_t>(member);
  else if constexpr (OptionalLength<T>)
    return member.metres();
  else
    return member;
}

template <class T>
void set_member(T& member, const SettingValue& value) {
  if constexpr (std::is_enum_v<T>) {
    const auto& words = WordsOf<T>::words;
    const auto found = std::find(words.begin(), words.end(), std::get<std::string>(value));
    assert(found != words.end());
    member = static_cast<T>(found - words.begin());
  } else if constexpr (std::floating_point<T> || OptionalLength<T>) {
    using Number = std::conditional_t<OptionalLength<T>, float, T>;
    const auto* single = std::get_if<float>(&value);
    member = T(static_cast<Number>(single ? *single : std::get<double>(value)));
  } else if constexpr (std::integral<T> && !std::same_as<T, bool>) {
    member = static_cast<T>(std::get<uint64_t>(value));
  } else {
    member = std::get<T>(value);
  }
}

/// The settings that components have described, table by table, in the order in which they are read: what decides
/// which others there are comes before these.
class Description {
 public:
  /// What is described next stands in this table.
  Description& in(std::string_view table) {
    table_ = table;
    return *this;
  }
  /// Adds a setting of that name to the table.
  void add(std::string_view name, Setting setting) {
    setting.key = table_ + "." + std::string(name);
    settings_.push_back(std::move(setting));
  }
  std::vector<Setting> take() { return std::move(settings_); }

 private:
  std::string table_;
  std::vector<Setting> settings_;
};

/// Describes members of a structure, whose defaults are those of `defaults`.
template <class Struct>
class Members {
 public:
  Members(Struct& of, Description& description, Struct defaults = {})
      : of_(&of), defaults_(std::move(defaults)), description_(&description) {}

  template <class T>
  void add(std::string_view name, T Struct::*member, Domain domain, std::string meaning,
           SettingTraits traits = {}) const {
    T& held = of_->*member;
    description_->add(name, {traits, "", std::move(meaning), std::move(domain), value_of_member(defaults_.*member),
                             [&held] { return value_of_member(held); },
                             [&held](const SettingValue& value) { set_member(held, value); }});
  }
  /// All words of an enumeration.
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(std::string_view name, Enum Struct::*member, std::string meaning, SettingTraits traits = {}) const {
    add(name, member, words_of<Enum>(), std::move(meaning), traits);
  }
  /// A set of items, each of which has a name in a list; `none` where it has none of them.
  template <class Set, class Info, class Item>
  void add_set(std::string_view name, Set Struct::*member, std::span<const Info> infos, Item Info::*item,
               std::string meaning, SettingTraits traits = {}, std::string none = "") const {
    const auto text = [infos, item, none](const Set& set) {
      std::string joined;
      for (const Info& info : infos)
        if (set.has(info.*item)) joined += (joined.empty() ? "" : "+") + std::string(info.name);
      return joined.empty() ? none : joined;
    };
    Set& held = of_->*member;
    const auto assign = [&held, infos, item](const SettingValue& value) {
      const std::vector<std::string> words = words_in(std::get<std::string>(value));
      for (const Info& info : infos)
        held.set(info.*item, std::find(words.begin(), words.end(), info.name) != words.end());
    };
    description_->add(name, {traits, "", std::move(meaning), WordSet{names_of(infos)}, text(defaults_.*member),
                             [&held, text] { return SettingValue(text(held)); }, assign});
  }

 private:
  Struct* of_;
  Struct defaults_;
  Description* description_;
};

}  // namespace vpm
