// The layers that a render can have of what its camera sees, besides the light.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "vpm/image/image.h"

namespace vpm {

/// A property of what a pixel's rays come through and to.
enum class ViewLayer : uint32_t { depth, normal, albedo, transmittance, single_scattering_albedo, emission, samples };

struct ViewLayerInfo {
  ViewLayer layer;
  std::string_view name;
};
/// All, in the order of ViewLayer.
inline constexpr std::array<ViewLayerInfo, 7> kViewLayers{
    {{ViewLayer::depth, "depth"},
     {ViewLayer::normal, "normal"},
     {ViewLayer::albedo, "albedo"},
     {ViewLayer::transmittance, "transmittance"},
     {ViewLayer::single_scattering_albedo, "single-scattering-albedo"},
     {ViewLayer::emission, "emission"},
     {ViewLayer::samples, "samples"}}};

/// A set of layers, empty by default.
class ViewLayerSet {
 public:
  constexpr bool has(ViewLayer layer) const { return (bits_ & bit(layer)) != 0; }
  constexpr void set(ViewLayer layer, bool in) { bits_ = in ? bits_ | bit(layer) : bits_ & ~bit(layer); }
  constexpr bool empty() const { return bits_ == 0; }
  bool operator==(const ViewLayerSet&) const = default;

 private:
  static constexpr uint32_t bit(ViewLayer layer) { return 1u << static_cast<uint32_t>(layer); }

  uint32_t bits_ = 0;
};

/// A layer as it is written: its channels are called name.C for each letter C, of which `image` has as many.
struct NamedLayer {
  std::string name, letters;
  Image image;
};

}  // namespace vpm
