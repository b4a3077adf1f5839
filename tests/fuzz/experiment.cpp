// Any bytes as an experiment. The scenes that it names are not read.
#include "fuzz/scratch.h"
#include "input/experiment_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::ScratchFolder folder;
  const std::string path = folder.put("experiment.toml", data, size);
  vpm::read_or_refuse([&] { vpm::load_comparison_plan(path); });
  return 0;
}
