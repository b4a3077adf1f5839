// The folder of a comparison: finished runs and references, so that a comparison goes on where it was interrupted.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/run.h"
#include "json.h"
#include "vpm/job/found_by_techniques.h"
#include "vpm/study/compare/errors.h"

namespace vpm::tools {

/// An array of objects, as the report of a render has it. What is not a number becomes null in its text.
Json techniques_json(const std::vector<FoundByTechnique>& all);
/// Throws Json::exception for what is no such array.
std::vector<FoundByTechnique> techniques_of(const Json& all);

/// The means over those of the repetitions (at least one) that use the same techniques as the first: it may be for each
/// to choose, and shares sum to 1 only over one choice.
std::vector<FoundByTechnique> mean_of_techniques(const std::vector<std::vector<FoundByTechnique>>& repetitions);

/// Runs and references are known by an identity: a text of all that decides what they are. Each stands in files named
/// by its fingerprint, and is taken for finished only where the identity in them is the very same.
class Store {
 public:
  /// Makes the folder where it is missing. Throws InputError where that fails.
  explicit Store(std::filesystem::path folder);

  /// A finished run; nothing where there is none. Without its pictures, which picture() reads. Throws InputError for
  /// files that are there but damaged.
  std::optional<std::vector<RunCost>> find_run(const std::string& identity) const;
  /// The picture of a finished run at a budget, counted from 0.
  Image picture(const std::string& identity, size_t budget) const;
  /// What a finished run chose, as "key=value key=value"; "" where that is nothing.
  std::string chosen(const std::string& identity) const;
  /// What techniques found in a finished run, at its last budget; nothing where it kept no layers.
  std::vector<FoundByTechnique> techniques(const std::string& identity) const;
  /// The pictures of these, which a finished run has that is the first of its repetitions. Throws InputError where the
  /// file of the picture at `budget`, the last one, does not hold them.
  std::vector<Image> parts(const std::string& identity, size_t budget) const;
  void add_run(const std::string& identity, const MethodRun& run) const;

  std::optional<Reference> find_reference(const std::string& identity) const;
  void add_reference(const std::string& identity, const Reference& reference) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path file(const char* kind, const std::string& identity, const std::string& extension) const;

  std::filesystem::path folder_;
};

/// What a run cost, as the text of a JSON object.
std::string cost_json(const RunCost& cost);

/// Reference::doubt of those that photon maps made: a kernel's bias is in them.
inline constexpr const char* kOfPhotons = "the reference is of photons and may be biased itself";

/// A reference read from a file: R, G, B, and the variance of these where the file has it (variance.R, ...), as those
/// have that vpm writes; else errors are computed as if it were exact, but biases against it are in doubt. So they are
/// where the file says that photons made it.
Reference read_reference(const std::filesystem::path& path);

}  // namespace vpm::tools
