// Any bytes as an experiment. The files that it may name lie beside it; the scenes among them are not read.
#include "vpm/study/compare/experiment.h"
#include "fuzz/scratch.h"

namespace vpm {
namespace {

/// The experiment's folder, with files to name in it.
struct ExperimentFolder : ScratchFolder {
  ExperimentFolder() {
    for (const char* name : {"a.toml", "b.toml", "a.exr", "smoke.vdb"}) std::ofstream(path(name)) << "any\n";
  }
};

}  // namespace
}  // namespace vpm

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::ExperimentFolder folder;
  const std::string path = folder.put("experiment.toml", data, size);
  vpm::read_or_refuse([&] { vpm::load_comparison_plan(path); });
  return 0;
}
