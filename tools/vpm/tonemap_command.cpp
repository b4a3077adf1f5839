// vpm tonemap: a picture for people's eyes.
#include <fmt/format.h>
#include <filesystem>

#include "commands.h"
#include "vpm/base/error.h"
#include "vpm/image/exr.h"
#include "vpm/image/png.h"

namespace vpm::tools {

int tonemap_command(const TonemapOptions& options) {
  if (std::filesystem::path(options.output).extension() != ".png")
    throw InputError(fmt::format("{}: the picture is a PNG file, its name must end in .png", options.output));
  const ExrPicture read = read_exr_picture(options.picture, options.layer, ExrPlanes::colour);
  for (const std::string& note : read.notes) fmt::print(stderr, "note: {}: {}\n", options.picture, note);
  const Image& picture = read.image;
  const float exposure = options.exposure ? *options.exposure : auto_exposure(picture);
  const size_t non_finite = write_png(options.output, picture, exposure);
  fmt::print("{}: {} x {} pixels, exposed by {:.3g} stops{}\n", options.output, picture.width, picture.height, exposure,
             non_finite > 0 ? fmt::format("; {} pixels are not finite, drawn magenta", non_finite) : "");
  return 0;
}

}  // namespace vpm::tools
