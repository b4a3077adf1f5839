// The shared memory holds the number of grids, and of each its medium's name, its role and itself. The message holds
// the version of vpm, since another one could not read that; a line feed; and the address of the memory. There is no
// address where the scene has no grids, and the message is empty where memory was refused.
#include "vpm/ranks/machine_grids.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "vpm/base/error.h"
#include "vpm/base/memory/packed_tables.h"
#include "vpm/base/memory/shared_memory.h"
#include "vpm/base/version.h"

namespace vpm {
namespace {

struct PlacedGrid {
  const Medium* medium;
  const GridRole* role;
  std::shared_ptr<const DensityGrid>* grid;  // the medium's
};

std::vector<PlacedGrid> grids_of(Scene& scene) {
  std::vector<PlacedGrid> grids;
  for (Medium& medium : scene.media)
    for (const GridRole& role : kGridRoles)
      if (medium.*role.grid) grids.push_back({&medium, &role, &(medium.*role.grid)});
  return grids;
}

void send_to_all(Ranks& machine, const std::string& bytes) {
  for (int rank = 1; rank < machine.size(); ++rank) machine.send(rank, bytes);
}

/// packed(const PlacedGrid&) is called for each grid once it is packed.
template <class IsPacked>
void pack(const std::vector<PlacedGrid>& grids, TablePacker& packer, IsPacked&& packed) {
  packer.add_one(uint64_t{grids.size()});
  for (const PlacedGrid& placed : grids) {
    packer.add(std::span<const char>(placed.medium->name));
    packer.add_one(static_cast<uint64_t>(placed.role - kGridRoles.data()));
    (*placed.grid)->pack(packer);
    packed(placed);
  }
}

size_t packed_bytes(const std::vector<PlacedGrid>& grids) {
  TablePacker counter(nullptr);
  pack(grids, counter, [](const PlacedGrid&) {});
  return counter.bytes();
}

GridsOfScene grids_in(const std::shared_ptr<const SharedMemory>& memory) {
  TableUnpacker packed(memory->bytes());
  GridsOfScene grids;
  for (auto left = packed.take_one<uint64_t>(); left > 0; --left) {
    const std::span<const char> medium = packed.take<char>();
    const GridRole& role = kGridRoles.at(packed.take_one<uint64_t>());
    grids.emplace(GridName{{medium.begin(), medium.end()}, std::string(role.name)},
                  std::make_shared<const DensityGrid>(packed, memory));
  }
  return grids;
}

std::string program() { return std::string(version()) + "\n"; }

}  // namespace

std::error_code share_grids(Ranks& machine, Scene& scene) {
  const std::vector<PlacedGrid> placed = grids_of(scene);
  if (placed.empty()) {
    send_to_all(machine, program());
    return {};
  }
  std::shared_ptr<SharedMemory> memory;
  try {
    memory = std::make_shared<SharedMemory>(packed_bytes(placed));
  } catch (const std::system_error& refused) {
    send_to_all(machine, {});
    return refused.code();
  }
  TablePacker packer(memory->data());
  pack(placed, packer,
       [](const PlacedGrid& done) { *done.grid = nullptr; });  // so that only one at a time is there twice
  memory->finish();
  const GridsOfScene grids = grids_in(memory);
  for (const PlacedGrid& own : placed) *own.grid = grids.at({own.medium->name, std::string(own.role->name)});
  send_to_all(machine, program() + memory->address());
  return {};
}

std::optional<GridsOfScene> shared_grids(Ranks& machine) {
  const std::string received = wait_for_message(machine).bytes;
  if (received.empty()) return std::nullopt;
  if (!received.starts_with(program())) throw InputError("the first rank of this machine is another vpm");
  const std::string address = received.substr(program().size());
  if (address.empty()) return GridsOfScene{};
  return grids_in(std::make_shared<const SharedMemory>(address));
}

}  // namespace vpm
