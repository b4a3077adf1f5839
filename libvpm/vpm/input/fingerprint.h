// What distinguishes one scene from another: the keys of its file with their values, and the bytes of the files that it
// names.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "vpm/input/node.h"
#include "vpm/integrators/choice.h"

namespace vpm {

struct Fingerprint {
  std::string hash;  // 16 hex digits: of all keys that change what a pass computes, and of the bytes of the files
  std::vector<std::pair<std::string, std::string>> contents;  // what of that is no setting, by name
};

/// Of a document with its options applied. Comments and white space do not take part, nor do settings that only say
/// which passes are rendered. `files` are those that it names, and `given` is what it was given in memory: names, and
/// hashes of values; `left_out` is what is made of what is left out. Throws InputError where one of the files cannot be
/// read.
Fingerprint fingerprint_of(const Document& document, const std::vector<std::string>& files,
                           const std::vector<std::pair<std::string, std::string>>& given, LeftOut left_out);

}  // namespace vpm
