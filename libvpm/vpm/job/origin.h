// Where a job was read from, so that another process can read it again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vpm/job/identity.h"
#include "vpm/job/render_job.h"

namespace vpm {

struct Origin {
  std::string scene;                   // absolute path of the scene file; empty: made in code
  std::vector<std::string> overrides;  // "key.path=value" options that changed it
  bool automatic = false;              // was what it leaves out to be chosen?
  uint64_t seed = 1;

  bool operator==(const Origin&) const = default;
};

Origin origin_of(const RenderJob& job);

/// As names and values without line feeds, and back, whatever bytes there are. Throws std::invalid_argument where
/// fields are not those of an origin.
Identity fields_of(const Origin& origin);
Origin origin_from(const Identity& fields);

}  // namespace vpm
