// vpm report: the report of a render, and its picture, as one page.
#include <fmt/format.h>
#include <filesystem>

#include "commands.h"
#include "report/page_data.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"

namespace vpm::tools {
namespace {

/// Throws InputError as read_report(), and where a section of the report is not what vpm render writes.
std::string page_of(const std::string& path) {
  try {
    return report_page(read_report(path));
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: the report is damaged: {}", path, error.what()));
  }
}

}  // namespace

int report_command(const ReportOptions& options) {
  namespace fs = std::filesystem;
  if (fs::path(options.report).extension() != ".json")
    throw InputError(fmt::format("{}: a report of vpm render is a file whose name ends in .json", options.report));
  const fs::path output =
      options.output.empty() ? fs::path(options.report).replace_extension(".html") : fs::path(options.output);
  if (output.extension() != ".html")
    throw InputError(fmt::format("{}: the page is an HTML file, its name must end in .html", output.string()));
  const std::string page = page_of(options.report);
  write_text(output, page);
  fmt::print("{}: {:.1f} MB, opens in a browser without a network\n", output.string(),
             static_cast<double>(page.size()) / 1e6);
  return 0;
}

}  // namespace vpm::tools
