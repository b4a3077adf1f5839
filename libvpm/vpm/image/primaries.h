// Colours of other primaries as those of Rec. 709, in which scenes and pictures are here.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

namespace vpm {

/// Chromaticities x, y of CIE 1931.
struct Primaries {
  glm::dvec2 red{0.64, 0.33}, green{0.30, 0.60}, blue{0.15, 0.06}, white{0.3127, 0.3290};  // Rec. 709

  /// To the four digits that such numbers are given with; or all zeros, as some writers put where they know none.
  bool are_those_of_rec709() const;
  bool operator==(const Primaries&) const = default;
};

/// Of a linear colour space by the names that OpenImageIO, OpenColorIO and the ASWF's list of interoperable spaces
/// give it; nothing for other names.
std::optional<Primaries> primaries_named(const std::string& colour_space);
/// Is it the name of a colour space whose values are no linear ones, as of displays?
bool is_encoded(const std::string& colour_space);

/// The matrix that makes colours of Rec. 709 of those of `primaries` [SMPTE1993]; white stays white, by Bradford's
/// adaptation [Lam1985]. Throws InputError where they span no colours.
glm::dmat3 to_rec709(const Primaries& primaries);

/// "its colours, of the primaries ..., are converted to Rec. 709".
std::string conversion_text(const Primaries& primaries);

}  // namespace vpm
