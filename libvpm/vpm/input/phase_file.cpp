// Two numbers a line.
#include "vpm/input/phase_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <fstream>

#include "vpm/base/error.h"

namespace vpm {
namespace {

/// The numbers of a line; none where something else is in it.
std::vector<double> numbers_of(std::string line) {
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == ',' || c == ';' || c == '\t' || c == '\r'; }, ' ');
  std::vector<double> numbers;
  const char *at = line.data(), *const end = line.data() + line.size();
  while (true) {
    while (at < end && *at == ' ') ++at;
    if (at == end) return numbers;
    if (*at == '+') ++at;
    double number = 0.0;
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error != std::errc() || (stop < end && *stop != ' ')) return {};
    numbers.push_back(number);
    at = stop;
  }
}

}  // namespace

std::shared_ptr<const PhaseTable> load_phase_table(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path + ": cannot be read");
  std::vector<double> degrees, values;
  bool begun = false;  // are there lines besides comments?
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::vector<double> numbers = numbers_of(line);
    const bool heading = numbers.empty() && !begun;
    begun = true;
    if (heading) continue;
    if (numbers.size() != 2)
      throw InputError(fmt::format("{}:{}: a line of a phase function is an angle in degrees and a value{}", path,
                                   number, numbers.size() > 2 ? "; all channels have the same" : ""));
    degrees.push_back(numbers[0]);
    values.push_back(numbers[1]);
  }
  try {
    return std::make_shared<const PhaseTable>(degrees, values);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path, error.what()));
  }
}

}  // namespace vpm
