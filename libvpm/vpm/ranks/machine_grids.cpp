// What is shared: the name of each medium that has a grid, and its grid; an empty name ends them. What is told: the
// program, whose tables others could not read, a line feed, and where the memory is found; nowhere for no grids.
#include "vpm/ranks/machine_grids.h"

#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "vpm/base/packed_tables.h"
#include "vpm/base/shared_memory.h"
#include "vpm/base/version.h"

namespace vpm {
namespace {

const std::string kNothing;

std::vector<Medium*> media_with_grids(Scene& scene) {
  std::vector<Medium*> media;
  for (Medium& medium : scene.media)
    if (medium.grid) media.push_back(&medium);
  return media;
}

std::span<const char> name_of(const Medium& medium) { return {medium.name.data(), medium.name.size()}; }

size_t packed_bytes(const std::vector<Medium*>& media) {
  TablePacker counter(nullptr);
  for (const Medium* medium : media) {
    counter.add(name_of(*medium));
    medium->grid->pack(counter);
  }
  counter.add(std::span<const char>());
  return counter.bytes();
}

/// Each grid is let go of once it is packed, so that no more than one is there twice.
void move_grids(const std::vector<Medium*>& media, std::byte* memory) {
  TablePacker packer(memory);
  for (Medium* medium : media) {
    packer.add(name_of(*medium));
    medium->grid->pack(packer);
    medium->grid = nullptr;
  }
  packer.add(std::span<const char>());
}

GridsOfMedia grids_in(const std::shared_ptr<const SharedMemory>& memory) {
  TableUnpacker packed(memory->bytes());
  GridsOfMedia grids;
  for (;;) {
    const std::span<const char> name = packed.take<char>();
    if (name.empty()) return grids;
    grids.emplace(std::string(name.begin(), name.end()), std::make_shared<const DensityGrid>(packed, memory));
  }
}

std::string program() { return std::string(version()) + "\n"; }

}  // namespace

void share_grids(Machine& machine, Scene& scene) {
  const std::vector<Medium*> media = media_with_grids(scene);
  if (media.empty()) return machine.tell(program());
  std::shared_ptr<SharedMemory> memory;
  try {
    memory = std::make_shared<SharedMemory>(packed_bytes(media));
  } catch (const std::system_error&) {
    machine.tell(kNothing);
    throw;
  }
  move_grids(media, memory->data());
  const GridsOfMedia grids = grids_in(memory);
  for (Medium* medium : media) medium->grid = grids.at(medium->name);
  machine.tell(program() + memory->address());
}

std::optional<GridsOfMedia> shared_grids(Machine& machine) {
  const std::string told = machine.hear();
  if (!told.starts_with(program())) return std::nullopt;
  const std::string address = told.substr(program().size());
  if (address.empty()) return GridsOfMedia{};
  return grids_in(std::make_shared<const SharedMemory>(address));
}

}  // namespace vpm
