// The parser's errors in vpm's words: the first argument that is not understood, and the option that was probably
// meant.
#include "refused_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>

#include "vpm/base/error.h"
#include "vpm/input/source.h"

namespace vpm::tools {
namespace {

/// "; did you mean 'that'?", or "".
std::string guess(const std::string& name, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(name, names);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// Of arguments that no option takes: of `app` before the command, of `command` behind it.
std::string text_of_extras(const CLI::App& app, const CLI::App& command) {
  if (!app.remaining().empty())
    return fmt::format("'{}' stands before the command: options come behind it", app.remaining().front());
  const std::vector<std::string> extras = command.remaining();
  const auto option = std::find_if(extras.begin(), extras.end(), [](const auto& e) { return e.starts_with("-"); });
  if (option == extras.end()) return fmt::format("'{}' is one argument too many", extras.at(0));
  const std::string name = option->substr(0, option->find('='));
  return fmt::format("there is no option '{}'{}", name, guess(name, option_names(command)));
}

}  // namespace

void check_command(const CLI::App& app, const std::string& name) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw InputError(fmt::format("there is no command '{}'{}; vpm help lists them", name, guess(name, names)));
}

std::string text_of_refusal(const CLI::App& app, const CLI::ParseError& refusal) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  if (commands.empty()) return fmt::format("{}; vpm help lists commands and options", refusal.what());
  const CLI::App& command = *commands.front();
  const bool extras = dynamic_cast<const CLI::ExtrasError*>(&refusal) != nullptr;
  return fmt::format("{}: {}\n  vpm help {} lists what it takes", command.get_name(),
                     extras ? text_of_extras(app, command) : refusal.what(), command.get_name());
}

}  // namespace vpm::tools
