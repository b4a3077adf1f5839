// What a reader is told of a render's settings: what each is, and commands that render it again.
#pragma once

#include "report/read_report.h"

namespace vpm::tools {

/// A row for each setting of the report: its `key`, `value` and `usual` value, whether `is_usual`, `meaning` and
/// allowed `values` in Markdown, and the `reason` of its choice where the render chose it.
Json shown_settings(const RenderReport& report);

/// Commands with what each `does`: one renders the same picture again, with what was chosen as it was chosen.
Json commands_again(const Json& report);

}  // namespace vpm::tools
