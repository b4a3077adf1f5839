// A machine whose ranks are threads of one process, or one thread by turns.
#pragma once

#include "ranks/ranks_in_memory.h"

namespace vpm {

class MachineInMemory final : public Machine {
 public:
  MachineInMemory(Post& post, int rank) : post_(post), rank_(post, rank) {}
  bool leads() const override { return rank_.leads(); }
  void tell(const std::string& bytes) override {
    for (int rank = 1; rank < post_.ranks(); ++rank) rank_.send(rank, bytes);
  }
  std::string hear() override { return wait_for_message(rank_).bytes; }

 private:
  Post& post_;
  RankInMemory rank_;
};

}  // namespace vpm
