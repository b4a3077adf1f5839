// vpm photons: scene file in; the photons of its maps, or how they flew, out.
#include <fmt/format.h>
#include <cstdio>

#include "commands.h"
#include "pass_run.h"
#include "this_process.h"
#include "vpm/base/parallel.h"
#include "vpm/input/scene_file.h"
#include "vpm/integrators/photon_map/stored_photons.h"
#include "vpm/job/messages.h"
#include "vpm/job/photon_files.h"

namespace vpm::tools {
namespace {

/// The photons of each map at each place, and the power that they brought there.
void print_photons(const StoredPhotons& stored) {
  struct Brought {
    uint64_t count = 0;
    Rgbd power{0.0};
  };
  std::vector<std::vector<Brought>> brought(stored.maps.size(), std::vector<Brought>(stored.places.size()));
  for (const StoredPhoton& photon : stored.photons) {
    Brought& there = brought[photon.map][photon.place];
    ++there.count;
    if (photon.event != PhotonEvent::flight) there.power += Rgbd(photon.power);
  }
  for (size_t map = 0; map < brought.size(); ++map)
    for (size_t place = 0; place < brought[map].size(); ++place)
      if (const auto& [count, power] = brought[map][place]; count > 0)
        fmt::print("  {} map, {}: {} photons, ({:.6g}, {:.6g}, {:.6g}) W\n", stored.maps[map], stored.places[place],
                   count, power.r, power.g, power.b);
}

}  // namespace

int photons_command(const PhotonsOptions& options) {
  set_threads(options.threads);
  const std::filesystem::path output =
      options.output.empty() ? std::filesystem::path(options.scene).stem().string() + ".ply" : options.output;
  RenderJob job = load_scene(options.scene, components_first(options.overrides));
  check_photon_file(output);
  check_not_read(output, job);
  if (options.seed) job.settings.seed = *options.seed;
  choose(job, *clock_of_process());
  print_notes(job);
  const PassProgress progress{progress_enabled(options.progress)};
  if (options.paths) {
    const PhotonFlights flights = photon_flights(job.scene, job.settings, options.pass, progress);
    write_flights(flights, output);
    print_warnings(warnings_of(flights.ledger));
    fmt::print("{}: {} flights of {} photons\n", output.string(), flights.flights.size(), flights.emitted);
    return 0;
  }
  const StoredPhotons stored = stored_photons(job.scene, job.settings, options.pass, progress);
  write_photons(stored, output);
  print_warnings(warnings_of(stored.ledger));
  if (stored.photons.empty())
    print_warnings(
        {"no photons are stored: maps store those in media that scatter and on surfaces that are neither "
         "mirrors nor smooth glass; --paths writes all flights"});
  fmt::print("{}: {} stored photons of {} emitted\n", output.string(), stored.photons.size(), stored.emitted);
  print_photons(stored);
  return 0;
}

}  // namespace vpm::tools
