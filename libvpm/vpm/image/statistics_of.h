// For which pixels the layers of statistics in a file were made.
#pragma once

#include <string>

#include "vpm/image/exr.h"

namespace vpm {

/// The attribute of files with layers of statistics that holds key_of_statistics().
inline constexpr const char* kStatisticsOf = "vpm.statisticsOf";

/// The size of a picture, and hashes of its bits and of those of its variances:
/// "640 x 480, 0123456789abcdef, 0123456789abcdef".
std::string key_of_statistics(const Image& radiance, const Image& variance);

/// Why the statistics of a file do not belong to its picture any more, as after resizing, a lossy compression, half
/// precision or a change of its colours: "they were made for 640 x 480 pixels, and the picture has 320 x 240"; or were
/// changed themselves. "" where they do, or where the file does not say what they were made for. `variance`: its layer.
std::string why_statistics_do_not_fit(const ExrPicture& picture, const Image& variance);

}  // namespace vpm
