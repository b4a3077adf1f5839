// The picture of a render or a light map as a file: linear EXR with its estimated error, and where it is
// from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vpm/film/view_layer.h"
#include "vpm/integrators/photon_map/surface/uv_layout.h"
#include "vpm/integrators/settings.h"
#include "vpm/job/render_job.h"
#include "vpm/render/render.h"

namespace vpm {

/// The attribute of pictures that holds the variance of the mean over pixels, of red, green and blue, (W/(m^2 sr))^2.
/// Pixels of photon maps are correlated: it does not follow from the variances of pixels.
inline constexpr const char* kVarianceOfMeans = "vpm.varianceOfMeans";

/// Further pictures of a render, none before its first pass: its layer_names(), from two passes on with a further layer
/// NAME.variance each, and its named_view_layers().
std::vector<NamedLayer> picture_layers(const RenderSettings& settings, const RenderResult& result);

/// Writes the mean of the passes, W/(m^2 sr), from two passes on with the variance of that mean (layer "variance") and,
/// where radii shrink, the bias that the passes show (layer "bias"), picture_layers(), and metadata under "vpm....".
/// Where the camera has a crop, that is the data window of the file, and the film its display window. The file appears
/// whole or not at all; throws InputError where it cannot be written.
void write_picture(const std::filesystem::path& path, const RenderJob& job, const RenderResult& result);

/// A light map as it is written: the mean of its passes, dilated() by kDilation texels.
Image light_map_of(const UvLayout& layout, const RenderResult& result);
inline constexpr int kDilation = 2;  // texels
/// Writes the light map of the shape named `mesh`, W/m^2, with the layers "coverage" and, from two passes on,
/// "variance". Throws InputError as write_picture().
void write_light_map(const std::filesystem::path& path, const RenderJob& job, const std::string& mesh,
                     const UvLayout& layout, const RenderResult& result);

}  // namespace vpm
