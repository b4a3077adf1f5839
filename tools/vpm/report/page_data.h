// The page of a render: report, settings and pictures as data, in its template; what the settings mean:
// what each is, and commands that render it again.
#pragma once

#include <string>

#include "report/read_report.h"

namespace vpm::tools {

/// A row for each setting of the report: its `key`, `value` and `default` value, whether `is_default`, `meaning` and
/// allowed `values` in Markdown, and the `reason` of its choice where the render chose it.
Json shown_settings(const RenderReport& report);

/// Commands with what each `does`: one renders the same picture again, with what was chosen as it was chosen.
Json commands_again(const Json& report);

/// The most pixels that a picture has in the page, and that all of them have together: 8 bytes of text each.
inline constexpr size_t kMostPixels = size_t{1} << 20;
inline constexpr size_t kMostPixelsInAll = 3 * kMostPixels / 2;

/// How large the squares of pixels are whose mean is a pixel of the page: the smallest for which that many pictures of
/// a size fit into it. 1: pixels are what they are.
int block_for(int width, int height, size_t pictures);

/// The page, as HTML. Pictures are half floats in it.
std::string report_page(const RenderReport& report);

}  // namespace vpm::tools
