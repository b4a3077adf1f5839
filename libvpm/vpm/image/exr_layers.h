// Which channels of an OpenEXR file are its picture.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace vpm {

/// A part of a file, by names alone.
struct ExrPartNames {
  std::string part;  // empty where it has none
  std::vector<std::string> channels;
};

/// The channels that make a picture: three, or the same three times where it is grey.
struct ExrColour {
  size_t part = 0;
  std::array<std::string, 3> channels;
};

/// The layer of this name or, where it is empty, that without a name, else the only one of colour, else the one called
/// Combined, whichever part holds it. A layer is what stands before the last dot of its channels R, G and B, in
/// capitals or small letters, or red, green and blue; or Y, or the only channel of a part that is named for light,
/// which is grey. Asked for by name may also be a part, or a channel, as grey. Throws InputError, which lists the
/// layers, where none or more than one is meant.
ExrColour choose_colour(const std::vector<ExrPartNames>& parts, const std::string& layer);

}  // namespace vpm
