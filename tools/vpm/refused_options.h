// What is said of a command line that cannot be parsed.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace vpm::tools {

/// Throws InputError where `name` is no command; it says which are nearest.
void check_command(const CLI::App& app, const std::string& name);

/// What is wrong, and what would be right.
std::string text_of_refusal(const CLI::App& app, const CLI::ParseError& refusal);

}  // namespace vpm::tools
