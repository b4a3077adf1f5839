// What is the same with MPI and without.
#include "vpm/ranks/ranks.h"

#include <charconv>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <thread>

#include "vpm/base/cancel.h"

namespace vpm {

int started_ranks() {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {  // Open MPI; MPICH and its kin
    const char* const value = std::getenv(variable);
    if (value == nullptr) continue;
    const std::string_view text(value);
    int ranks = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), ranks).ec == std::errc() && ranks > 0) return ranks;
  }
  return 1;
}

Message wait_for_message(Ranks& ranks) {
  for (;;) {
    cancellation_point();
    if (std::optional<Message> message = ranks.poll()) return std::move(*message);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // the library's own wait would keep a core busy
  }
}

}  // namespace vpm
