// One process by itself.
#pragma once

#include <cassert>
#include <cstdlib>

#include "vpm/ranks/ranks.h"

namespace vpm {

class Alone final : public Ranks {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void send(int, const std::string&) override { assert(false); }  // there is nobody
  std::optional<Message> poll() override { return std::nullopt; }
  Ranks* machine() override { return nullptr; }
  void abort(int status) override { std::exit(status); }
};

}  // namespace vpm
