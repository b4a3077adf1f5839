// Counting in hot loops, and structures of counts that list their members once: by that list they are merged, kept in
// files and reported.
#pragma once

#include <algorithm>
#include <concepts>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace vpm {

/// Does this program count?
#ifdef VPM_NO_COUNTERS
inline constexpr bool kCounts = false;
#else
inline constexpr bool kCounts = true;
#endif

/// Adds to a counter that no pass is decided by and that no warning rests on; only the pilot of automatic settings
/// goes by some. A program built with VPM_COUNTERS=OFF counts nothing here, to be timed against one that does.
template <class Counter, class Number = int>
inline void count([[maybe_unused]] Counter& counter, [[maybe_unused]] Number number = 1) {
  if constexpr (kCounts) counter += static_cast<Counter>(number);
}

/// What two parts' counts make of the whole's: a structure with a merge() of its own goes by that.
enum class CountRule { sum, largest, last };

/// A member in the list.
template <class Counts, class T>
struct Counter {
  std::string_view key;  // in reports and files; of a member with a list of its own: what stands before its keys
  T Counts::*member;
  CountRule rule = CountRule::sum;
};
template <class Counts, class T>
Counter(const char*, T Counts::*, CountRule = CountRule::sum) -> Counter<Counts, T>;

/// A structure with a static function counters() that gives a tuple of Counter.
template <class T>
concept ListsCounters = requires {
  T::counters();
};

/// Does the list name every member? By their sizes, for structures without padding.
template <ListsCounters T>
consteval bool lists_every_member() {
  const auto size = []<class Counts, class M>(const Counter<Counts, M>&) { return sizeof(M); };
  return std::apply([&](const auto&... counters) { return (size(counters) + ...); }, T::counters()) == sizeof(T);
}

/// Calls visit(key, number) for each member, and for those of members with lists of their own in their places; keys
/// are joined by dots.
template <class Counts, class Visit>
requires ListsCounters<std::remove_const_t<Counts>>
void for_each_counter(Counts& counts, Visit&& visit, const std::string& before = "") {
  const auto use = [&](const auto& counter) {
    const std::string key = before + (before.empty() || counter.key.empty() ? "" : ".") + std::string(counter.key);
    auto& number = counts.*counter.member;
    if constexpr (ListsCounters<std::remove_cvref_t<decltype(number)>>)
      for_each_counter(number, visit, key);
    else
      visit(key, number);
  };
  std::apply([&](const auto&... counters) { (use(counters), ...); }, std::remove_const_t<Counts>::counters());
}

/// Adds the counts of a further part.
template <ListsCounters T>
void merge_counters(T& counts, const T& part) {
  const auto merge = [&](const auto& counter) {
    auto& number = counts.*counter.member;
    const auto& other = part.*counter.member;
    if constexpr (requires { number.merge(other); })
      number.merge(other);
    else if constexpr (std::totally_ordered<std::remove_cvref_t<decltype(number)>>)
      number = counter.rule == CountRule::sum       ? number + other
               : counter.rule == CountRule::largest ? std::max(number, other)
                                                    : other;
    else
      number += other;
  };
  std::apply([&](const auto&... counters) { (merge(counters), ...); }, T::counters());
}

}  // namespace vpm
