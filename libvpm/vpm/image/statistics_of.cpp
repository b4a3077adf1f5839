// Keys of pictures, by size and bits.
#include "vpm/image/statistics_of.h"

#include <fmt/format.h>

#include "vpm/base/fnv.h"

namespace vpm {

namespace {

std::string hash_of(const Image& image) {
  Fnv1a hash;
  hash.add({reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size() * sizeof(Rgb)});
  return hash.digits();
}

std::string key_of_picture(const Image& radiance) {
  return fmt::format("{} x {}, {}", radiance.width, radiance.height, hash_of(radiance));
}

}  // namespace

std::string key_of_statistics(const Image& radiance, const Image& variance) {
  return key_of_picture(radiance) + ", " + hash_of(variance);
}

std::string why_statistics_do_not_fit(const ExrPicture& picture, const Image& variance) {
  const auto found = picture.file.metadata.find(kStatisticsOf);
  if (found == picture.file.metadata.end()) return "";
  const std::string& of = found->second;
  if (picture.file.held.width() <= 0 || picture.file.held.height() <= 0)
    return "the file holds no pixels of its window";
  const Image held = cropped(picture.image, picture.file.held);
  const std::string key = key_of_picture(held), size = of.substr(0, of.find(','));
  if (size != key.substr(0, key.find(',')))
    return fmt::format("they were made for {} pixels, and the picture has {} x {}", size, held.width, held.height);
  if (!of.starts_with(key)) return "the picture's values were changed since they were made";
  if (of != key_of_statistics(held, cropped(variance, picture.file.held))) return "they were changed since then";
  return "";
}

}  // namespace vpm
