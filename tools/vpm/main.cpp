// vpm: the command that the command line names, errors into exit status 2.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <sstream>

#include "command_line.h"
#include "refused_options.h"
#include "this_process.h"
#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/ranks/ranks.h"

namespace {

using namespace vpm;
using namespace vpm::tools;

/// The arguments, where "help" and "help COMMAND" stand for what --help stands for.
std::vector<char*> with_help_as_option(int argc, char** argv) {
  static char option[] = "--help";
  std::vector<char*> arguments(argv, argv + argc);
  if (argc > 1 && std::strcmp(argv[1], "help") == 0) {
    arguments.erase(arguments.begin() + 1);
    arguments.push_back(option);
  }
  return arguments;
}

int run(int argc, char** argv) {
  CLI::App app("vpm: volumetric photon mapping", "vpm");
  CommandLine options;
  declare_commands(app, options);
  if (argc == 1) {
    fmt::print(stderr, "{}", app.help());
    return kBadInput;
  }
  const bool asks_help = std::strcmp(argv[1], "help") == 0;
  const int named = asks_help ? 2 : 1;
  if (named < argc && argv[named][0] != '-') check_command(app, argv[named]);
  const std::vector<char*> arguments = with_help_as_option(argc, argv);
  try {
    app.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::Success& asked) {
    std::ostringstream help;  // in a stream of its own main() would not see that it cannot be written
    app.exit(asked, help, help);
    fmt::print("{}", help.str());
    return 0;
  } catch (const CLI::ParseError& refusal) {
    throw InputError(text_of_refusal(app, refusal));
  }
  if (app.got_subcommand("render")) return render_command(options.render);
  if (const int ranks = started_ranks(); ranks > 1)
    throw InputError(fmt::format("{} processes were started to do the same: only render shares its work", ranks));
  if (app.got_subcommand("view")) return view_command(options.view);
  if (app.got_subcommand("merge")) return merge_command(options.merge);
  if (app.got_subcommand("tonemap")) return tonemap_command(options.tonemap);
  if (app.got_subcommand("bake")) return bake_command(options.bake);
  if (app.got_subcommand("photons")) return photons_command(options.photons);
  if (app.got_subcommand("fluence")) return fluence_command(options.fluence);
  if (app.got_subcommand("measure")) return measure_command(options.measure);
  if (app.got_subcommand("compare")) return compare_command(options.compare);
  if (app.got_subcommand("info")) return info_command(options.info);
  if (app.got_subcommand("error")) return error_command(options.error);
  if (app.got_subcommand("report")) return report_command(options.report);
  if (app.got_subcommand("mesh")) return mesh_command(options.mesh);
  if (app.got_subcommand("validate")) return validate_command(options.validate);
  if (app.got_subcommand("upgrade")) return upgrade_command(options.upgrade);
  if (app.got_subcommand("exact")) return exact_command(options.exact);
  return media_command(options.media);
}

}  // namespace

int main(int argc, char** argv) {
  clock_of_process();
  std::signal(SIGXFSZ, SIG_IGN);  // a file larger than `ulimit -f` allows is an error of its writing, not vpm's end
  try {
    const CancelScope asked_to_end(stop_on_signals());
    const int status = run(argc, argv);
    if (std::fflush(stdout) == 0) return status;
    fmt::print(stderr, "vpm: cannot write to standard output: {}\n", std::strerror(errno));
  } catch (...) {
    const Failure failure = failure_of(std::current_exception());
    fmt::print(stderr, "vpm: {}\n", failure.message);
    return failure.status;
  }
  return kFailed;
}
