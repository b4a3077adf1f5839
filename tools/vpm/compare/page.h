// The report of a comparison as one page, with plots, tables and pictures, that needs nothing but a browser.
#pragma once

#include <string>
#include <vector>

#include "vpm/image/image.h"

namespace vpm::tools {

/// What a method's repetitions made of a scene.
struct MethodImages {
  Image first;                         // one of them
  Image mean;                          // of all
  std::vector<Image> techniques = {};  // what each finds of `first`, where layers are kept
};
/// `repetitions` are of one size; there is at least one.
MethodImages method_images(const std::vector<Image>& repetitions);

/// The pictures of a scene that the page shows.
struct PageImages {
  Image reference;
  std::vector<MethodImages> methods;
};

/// The page, as HTML. `results` is the text of results_json(), `images` those of its scenes. Pictures are half floats
/// in it: 8 bytes to a pixel.
std::string results_page(const std::string& results, const std::vector<PageImages>& images);

}  // namespace vpm::tools
