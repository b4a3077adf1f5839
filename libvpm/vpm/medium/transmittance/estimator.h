// Transmittance estimation: one interface, and the list of estimators. Those of one kind share a file of this folder.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "vpm/base/rng.h"
#include "vpm/base/settings/parameter.h"
#include "vpm/base/vec.h"
#include "vpm/medium/medium.h"

namespace vpm {

/// A transmittance per channel, with the look-ups of density and of bounds it took. Values below 0 and above 1 are
/// right where their mean is: whoever uses them must neither clamp nor drop them.
struct TransmittanceEstimate {
  Rgb value{1.0f};
  uint32_t lookups = 0;
  uint32_t bricks = 0;  // of a grid, whose bounds were looked up
};

class TransmittanceEstimator {
 public:
  virtual ~TransmittanceEstimator() = default;
  virtual TransmittanceEstimate estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                         Rng& rng) const = 0;
};

struct TransmittanceSettings {
  std::string estimator = "regular";
  Parameters parameters{};  // numbers of that estimator: "step", "samples"
};

/// An estimator, with what a user should know of it: each file of this folder has some, and estimator.cpp the list.
struct EstimatorInfo {
  std::string_view name;
  std::string_view summary;
  std::string_view failure;  // where it costs much or errs
  std::string_view source;   // key of papers/references.bib
  bool unbiased = true;
  std::span<const Parameter> parameters{};
  std::unique_ptr<TransmittanceEstimator> (*make)(ParameterValues numbers) = nullptr;
};
std::span<const EstimatorInfo> transmittance_estimators();
/// The estimator of that name; null where there is none. Throws std::invalid_argument where it has no parameter of a
/// name that is given.
std::unique_ptr<TransmittanceEstimator> make_transmittance_estimator(const TransmittanceSettings& settings);

/// Describes `type` and the parameters of the estimator that it names.
void describe(TransmittanceSettings& settings, Description& description);

}  // namespace vpm
