// Lines are added to the whole file, which is replaced: it is never half written.
#include "error_log.h"

#include <fmt/format.h>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "compare/store.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"

namespace vpm::tools {

namespace {

constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();

}  // namespace

ErrorLog::ErrorLog(const std::filesystem::path& reference, std::filesystem::path csv, const Film& film,
                   const Camera& camera)
    : reference_(read_reference(reference)), csv_(std::move(csv)) {
  check_writable(csv_, 1 << 16);
  const Image& truth = reference_.mean;
  const PixelRect rendered = camera.rendered();
  if (reference_.part && common_pixels(*reference_.part, rendered) != rendered)
    throw InputError(
        fmt::format("{}: the reference is a crop, and lacks pixels that are rendered", reference.string()));
  if (camera.crop && truth.width == camera.width && truth.height == camera.height) {
    reference_.mean = cropped(truth, *camera.crop);
    reference_.variance = cropped(reference_.variance, *camera.crop);
  }
  if (truth.width != film.width() || truth.height != film.height())
    throw InputError(fmt::format("{}: the reference has {} x {} pixels, but the render {} x {}", reference.string(),
                                 truth.width, truth.height, film.width(), film.height()));
  keep_lines_up_to(film.passes());
}

void ErrorLog::keep_lines_up_to(int passes) {
  std::ifstream csv(csv_);
  std::string line;
  std::getline(csv, line);  // names of columns
  while (std::getline(csv, line)) {
    const int at = std::atoi(line.c_str());
    if (at > passes) return;
    last_ = at;
    text_ += line + '\n';
  }
}

void ErrorLog::add(const RenderResult& so_far) {
  if (so_far.film.passes() >= 1.1 * last_) write(so_far);
}

void ErrorLog::finish(const RenderResult& result) {
  if (result.film.passes() > last_) write(result);
}

void ErrorLog::write(const RenderResult& so_far) {
  last_ = so_far.film.passes();
  const PictureErrors errors = picture_errors(so_far.film.mean(), reference_);
  const std::optional<StatedError> stated = stated_error_of(so_far);
  text_ += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.8g},{:.6g},{:.6g},{:.6g}\n", so_far.film.passes(), so_far.seconds,
                       errors.mse, errors.relative_mse, errors.mean_ratio, stated ? stated->total.value : kNotStated,
                       stated ? stated->total.standard_error : kNotStated, stated ? stated->highest : kNotStated);
  write_text(csv_, text_);
}

}  // namespace vpm::tools
