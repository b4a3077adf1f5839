// Error against time of a render that knows the truth.
#pragma once

#include <filesystem>
#include <string>

#include "vpm/render/render.h"
#include "vpm/study/compare/errors.h"

namespace vpm::tools {

/// Writes a CSV file that a render keeps up to date: passes, seconds, MSE, relative MSE (both less the reference's own
/// noise), the mean over the reference's, and what the render itself states: StatedError::total with its standard
/// error, and ::highest; nan below kLeastPasses passes. A line for each tenth more passes, and one for the last.
class ErrorLog {
 public:
  /// Throws InputError where the reference cannot be read or has another size than the film, and where the CSV file
  /// could not be written. Where the camera has a crop, the reference may be that of the whole. Where the film has
  /// passes already, the lines that the file has of them stay.
  ErrorLog(const std::filesystem::path& reference, std::filesystem::path csv, const Film& film, const Camera& camera);

  /// After each pass; and once more after the last.
  void add(const RenderResult& so_far);
  void finish(const RenderResult& result);

 private:
  void keep_lines_up_to(int passes);
  void write(const RenderResult& so_far);

  Reference reference_;
  std::filesystem::path csv_;
  std::string text_ = "passes,seconds,mse,relative_mse,mean_ratio,stated,standard_error,below\n";
  int last_ = 0;  // passes at the last line
};

}  // namespace vpm::tools
