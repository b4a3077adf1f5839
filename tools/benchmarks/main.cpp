// bench: what vpm's parts cost, side by side with those of other libraries.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>

#include "benchmarks/bench.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"

namespace vpm::bench {
namespace {

constexpr Subject kSubjects[] = {
    {"lanes", "numbers side by side, as gathers take them", measure_lanes},
    {"lookups", "density look-ups in a cloud of 256^3 voxels", measure_lookups},
    {"flights", "free flights through that cloud", measure_flights},
    {"transmittance", "transmittance estimators in that cloud", measure_transmittance},
    {"radius", "about 50 photons within a fixed radius", measure_radius},
    {"nearest", "the 50 nearest photons", measure_nearest},
    {"many-nearest", "sums over the 10,000 nearest photons", measure_many_nearest},
    {"build", "building photon maps", measure_build},
    {"beams", "photon beams that rays pass, with building their map", measure_beams},
    {"scaling", "tracing, building and queries by the number of photons and of threads", measure_scaling},
    {"emission", "emitting a photon, by kind of light", measure_emission},
    {"scattering", "scattering a photon from a surface, by material", measure_scattering}};

const Subject& find_subject(const std::string& name) {
  const auto* found =
      std::find_if(std::begin(kSubjects), std::end(kSubjects), [&](const Subject& s) { return s.name == name; });
  if (found == std::end(kSubjects)) throw InputError(fmt::format("there is no benchmark '{}'; see --list", name));
  return *found;
}

void write_json(const Bench& bench, const std::string& path) {
  std::ofstream file(path);
  file << fmt::format("[\n{}\n]\n", fmt::join(bench.json(), ",\n")) << std::flush;
  if (!file) throw InputError(fmt::format("{}: cannot be written", path));
}

int run(const std::vector<std::string>& names, const Sizes& sizes, int repetitions, const std::string& json) {
  std::vector<Subject> chosen;
  for (const std::string& name : names) chosen.push_back(find_subject(name));
  if (names.empty()) chosen.assign(std::begin(kSubjects), std::end(kSubjects));
  Bench bench(repetitions);
  for (const Subject& subject : chosen) {
    set_threads(1);
    subject.measure(bench, sizes);
  }
  if (!json.empty()) write_json(bench, json);
  if (!bench.agrees()) fmt::print(stderr, "bench: some alternatives do not agree\n");
  return bench.agrees() ? 0 : 1;
}

}  // namespace
}  // namespace vpm::bench

int main(int argc, char** argv) {
  CLI::App app("What vpm's parts cost, side by side with those of other libraries. On one thread unless said.",
               "bench");
  std::vector<std::string> names;
  vpm::bench::Sizes sizes;
  int repetitions = 9;
  bool list = false;
  std::string json;
  app.add_option("NAME", names, "what to measure; all where none is named");
  app.add_flag("--list", list, "print the names");
  app.add_option("--repetitions", repetitions, "of each alternative")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--photons", sizes.photons, "the largest maps; 100000000 takes 20 GB")->capture_default_str();
  app.add_option("--json", json, "write the figures to a file");
  CLI11_PARSE(app, argc, argv);
  if (list) {
    for (const vpm::bench::Subject& s : vpm::bench::kSubjects) fmt::print("{:<14} {}\n", s.name, s.summary);
    return 0;
  }
  try {
    return vpm::bench::run(names, sizes, repetitions, json);
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench: {}\n", e.what());
    return 2;
  }
}
