// Counts as named fields, for files and for messages between processes.
#pragma once

#include "vpm/base/statistics/channel_moments.h"
#include "vpm/estimate/statistics.h"
#include "vpm/render/named_fields.h"

namespace vpm {

template <>
inline constexpr std::string_view kFieldType<Rgbd> = "rgb64";
template <>
inline constexpr std::string_view kFieldType<ChannelMoments> = "moments_rgb";
template <>
inline constexpr std::string_view kFieldType<WeightMoments> = "weights";

inline void append_counters(std::string& bytes, const RenderStatistics& statistics) {
  for_each_counter(
      statistics, [&](const std::string& name, const auto& number) { append_field(bytes, name, number); },
      "statistics");
}

/// Throws FieldError where a count is missing.
inline void take_counters(NamedFields& fields, RenderStatistics& statistics) {
  for_each_counter(
      statistics,
      [&](const std::string& name, auto& number) {
        number = fields.take<std::remove_reference_t<decltype(number)>>(name);
      },
      "statistics");
}

}  // namespace vpm
