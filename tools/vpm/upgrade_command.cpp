// vpm upgrade: files of older versions with the keys of today.
#include <fmt/format.h>
#include <cstdio>
#include <filesystem>

#include "commands.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/input/source.h"
#include "vpm/input/toml/old_keys.h"
#include "vpm/input/toml/upgrade.h"

namespace vpm::tools {
namespace {

void print_keys() {
  for (const OldKey& old : old_keys()) fmt::print("{} {}\n", old.old_key, old.key);
}

void upgrade_file(const std::string& path, const std::string& output) {
  const std::string before = read_whole_file(path);
  const Upgraded upgraded = upgrade(path, before);
  for (const std::string& note : upgraded.notes) fmt::print(stderr, "note: {}: {}\n", path, note);
  if (output.empty() && upgraded.text == before) return fmt::print("{}: has no old keys\n", path);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!output.empty()) {
    if (std::filesystem::exists(output)) throw InputError(fmt::format("{}: there is such a file already", output));
    if (std::filesystem::path(output).parent_path() != folder)
      fmt::print(stderr, "note: {}: files that it names are looked for from its own folder now\n", output);
  }
  const std::string kept = path + ".old";
  if (output.empty()) {
    if (std::filesystem::exists(kept))
      throw InputError(
          fmt::format("{}: would be kept as {}, but there is such a file: remove it, or write another file "
                      "with -o",
                      path, kept));
    write_text(kept, before);
  }
  write_text(output.empty() ? path : output, upgraded.text);
  fmt::print("{}: {}\n", path, output.empty() ? "rewritten; the old file is " + kept : "written to " + output);
}

}  // namespace

int upgrade_command(const UpgradeOptions& options) {
  if (options.keys) print_keys();
  if (options.files.empty() && !options.keys) throw InputError("name the files to rewrite");
  if (options.files.size() > 1 && !options.output.empty())
    throw InputError(
        "-o names one file, and there are several to rewrite: leave it out, and each is rewritten in place");
  int status = 0;
  for (const std::string& path : options.files) try {
      upgrade_file(path, options.output);
    } catch (const InputError& error) {
      std::fflush(stdout);
      fmt::print(stderr, "vpm: {}\n", error.what());
      status = 2;
    }
  return status;
}

}  // namespace vpm::tools
