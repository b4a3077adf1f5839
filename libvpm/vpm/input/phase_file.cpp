// Two numbers a line.
#include "vpm/input/phase_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "vpm/base/error.h"
#include "vpm/base/vec.h"

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

/// The lines of a file: a place and one or three values in each.
struct PhaseRows {
  std::vector<double> places;
  std::vector<std::vector<double>> columns;

  /// Where a line has another number of numbers than the first, it is refused.
  void add(const std::vector<double>& numbers, const std::string& path, int line) {
    const size_t count = numbers.size();
    if ((count != 2 && count != 4) || (!columns.empty() && columns.size() + 1 != count))
      throw InputError(fmt::format(
          "{}:{}: a line of a phase function is an angle in degrees, or a cosine, and a value, or one each of red, "
          "green and blue; the same in all lines",
          path, line));
    columns.resize(count - 1);
    places.push_back(numbers[0]);
    for (size_t c = 0; c + 1 < count; ++c) columns[c].push_back(numbers[c + 1]);
  }
  void reverse() {
    std::reverse(places.begin(), places.end());
    for (std::vector<double>& column : columns) std::reverse(column.begin(), column.end());
  }
  /// Cosines become degrees, which rise.
  void order() {
    if (places.size() < 2) return;
    if (places.front() > places.back()) reverse();
    if (places.front() != -1.0 || places.back() != 1.0) return;
    for (double& place : places) {
      if (!(std::abs(place) <= 1.0))
        throw InputError(fmt::format("{:g} stands among cosines, which go from -1 to 1", place));
      place = std::acos(place) * 180.0 / kPiD;
    }
    reverse();
  }
};

PhaseRows read_rows(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path + ": cannot be read");
  PhaseRows rows;
  bool begun = false;  // are there lines besides comments?
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::vector<double> numbers = numbers_of(line);
    const bool heading = numbers.empty() && !begun;
    begun = true;
    if (!heading) rows.add(numbers, path, number);
  }
  return rows;
}

std::vector<double> mean_of(const PhaseRows& rows) {
  std::vector<double> mean(rows.places.size(), 0.0);
  for (const std::vector<double>& column : rows.columns) {
    const double share = 1.0 / (static_cast<double>(rows.columns.size()) * PhaseTable(rows.places, column).total());
    for (size_t i = 0; i < mean.size(); ++i) mean[i] += share * column[i];
  }
  return mean;
}

}  // namespace

std::shared_ptr<const PhaseTable> load_phase_table(const std::string& path) {
  PhaseRows rows = read_rows(path);
  try {
    rows.order();
    if (rows.columns.size() < 2)
      return std::make_shared<const PhaseTable>(rows.places, rows.columns.empty() ? rows.places : rows.columns[0]);
    return std::make_shared<const PhaseTable>(rows.places, mean_of(rows), static_cast<int>(rows.columns.size()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path, error.what()));
  }
}

}  // namespace vpm
