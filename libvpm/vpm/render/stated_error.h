// The error that a render states: how far its picture is estimated to be from the truth, and how sure that is.
#pragma once

#include "vpm/film/film.h"

namespace vpm {

/// Relative MSEs, as relative_mse(): of variance and squared bias.
struct StatedError {
  Estimated total;
  Estimated variance;      // its part
  Estimated squared_bias;  // its part, >= 0
  bool bias_seen = false;  // more than noise in FilmErrors::bias_part
  /// Which total and squared bias are below with a confidence of about 80 %. The first stops a render.
  double highest = 0.0, highest_squared_bias = 0.0;
};

StatedError stated_error(const FilmErrors& errors);

}  // namespace vpm
