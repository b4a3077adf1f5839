// What stands in a checkpoint between its first lines and its checksum, made a checkpoint again.
#pragma once

#include <fmt/format.h>
#include <string>
#include <string_view>

#include "vpm/base/fnv.h"
#include "vpm/job/checkpoint.h"

namespace vpm {

inline const Identity kFuzzIdentity{{"scene", "fuzz"}};  // of the render

inline std::string whole_checkpoint(std::string_view body) {
  std::string whole =
      fmt::format("vpm checkpoint of a render\nformat {}\nidentity 1\nscene=fuzz\norigin 0\n", kCheckpointFormat);
  whole.append(body);
  Fnv1a hash;
  hash.add(std::string_view(whole));
  return whole + hash.digits();
}

}  // namespace vpm
