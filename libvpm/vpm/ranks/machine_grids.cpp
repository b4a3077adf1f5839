// The shared memory holds the number of media that have a grid, and of each its name and its grid. The message holds
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

std::vector<Medium*> media_with_grids(Scene& scene) {
  std::vector<Medium*> media;
  for (Medium& medium : scene.media)
    if (medium.grid) media.push_back(&medium);
  return media;
}

void send_to_all(Ranks& machine, const std::string& bytes) {
  for (int rank = 1; rank < machine.size(); ++rank) machine.send(rank, bytes);
}

/// packed(Medium&) is called for each medium once it is packed.
template <class IsPacked>
void pack(const std::vector<Medium*>& media, TablePacker& packer, IsPacked&& packed) {
  packer.add_one(uint64_t{media.size()});
  for (Medium* medium : media) {
    packer.add(std::span<const char>(medium->name));
    medium->grid->pack(packer);
    packed(*medium);
  }
}

size_t packed_bytes(const std::vector<Medium*>& media) {
  TablePacker counter(nullptr);
  pack(media, counter, [](const Medium&) {});
  return counter.bytes();
}

GridsOfMedia grids_in(const std::shared_ptr<const SharedMemory>& memory) {
  TableUnpacker packed(memory->bytes());
  GridsOfMedia grids;
  for (auto left = packed.take_one<uint64_t>(); left > 0; --left) {
    const std::span<const char> name = packed.take<char>();
    grids.emplace(std::string(name.begin(), name.end()), std::make_shared<const DensityGrid>(packed, memory));
  }
  return grids;
}

std::string program() { return std::string(version()) + "\n"; }

}  // namespace

std::error_code share_grids(Ranks& machine, Scene& scene) {
  const std::vector<Medium*> media = media_with_grids(scene);
  if (media.empty()) {
    send_to_all(machine, program());
    return {};
  }
  std::shared_ptr<SharedMemory> memory;
  try {
    memory = std::make_shared<SharedMemory>(packed_bytes(media));
  } catch (const std::system_error& refused) {
    send_to_all(machine, {});
    return refused.code();
  }
  TablePacker packer(memory->data());
  pack(media, packer, [](Medium& medium) { medium.grid = nullptr; });  // so that only one at a time is there twice
  memory->finish();
  const GridsOfMedia grids = grids_in(memory);
  for (Medium* medium : media) medium->grid = grids.at(medium->name);
  send_to_all(machine, program() + memory->address());
  return {};
}

std::optional<GridsOfMedia> shared_grids(Ranks& machine) {
  const std::string received = wait_for_message(machine).bytes;
  if (received.empty()) return std::nullopt;
  if (!received.starts_with(program())) throw InputError("the first rank of this machine is another vpm");
  const std::string address = received.substr(program().size());
  if (address.empty()) return GridsOfMedia{};
  return grids_in(std::make_shared<const SharedMemory>(address));
}

}  // namespace vpm
