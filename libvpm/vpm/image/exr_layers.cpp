// Layers by the names of their channels.
#include "vpm/image/exr_layers.h"

#include <algorithm>
#include <map>
#include <set>

#include "vpm/base/error.h"
#include "vpm/base/letters.h"

namespace vpm {
namespace {

/// Are channels, layers or parts of this name of depths, places, shares or numbers of objects?
bool is_no_light(const std::string& name) {
  return std::set<std::string>{"x", "z", "zback", "depth", "mist", "a", "alpha", "id", "u", "v"}.contains(
      small_letters(name));
}

std::string last_name_of(const std::string& name) { return name.substr(name.rfind('.') + 1); }

/// Is the layer of shares of objects by hashes of their names, as Cryptomatte has it?
bool is_cryptomatte(const std::string& layer) { return small_letters(last_name_of(layer)).starts_with("crypto"); }

struct Layer {
  std::string part, name;
  ExrColour colour;

  /// What to ask for it by.
  std::string title() const { return name.empty() ? part : name; }
  std::string last_name() const { return last_name_of(title()); }
  bool is_called(const std::string& asked) const {
    return asked == name || asked == part || asked == part + "." + name || asked == last_name();
  }
};

/// The channels of each layer of a part, by the small letters of what each shows.
std::map<std::string, std::map<std::string, std::string>> by_layer(const ExrPartNames& part) {
  std::map<std::string, std::map<std::string, std::string>> layers;
  for (const std::string& channel : part.channels) {
    const size_t dot = channel.rfind('.');
    const std::string layer = dot == std::string::npos ? "" : channel.substr(0, dot);
    layers[layer][small_letters(channel.substr(dot == std::string::npos ? 0 : dot + 1))] = channel;
  }
  return layers;
}

std::vector<Layer> colour_layers(const std::vector<ExrPartNames>& parts) {
  std::vector<Layer> found;
  for (size_t i = 0; i < parts.size(); ++i)
    for (const auto& layer : by_layer(parts[i])) {
      const std::string& name = layer.first;
      const std::map<std::string, std::string>& shows = layer.second;
      if (is_cryptomatte(name.empty() ? parts[i].part : name)) continue;
      const auto add_colour = [&](const char* r, const char* g, const char* b) {
        if (!shows.contains(r) || !shows.contains(g) || !shows.contains(b)) return false;
        found.push_back({parts[i].part, name, {i, {shows.at(r), shows.at(g), shows.at(b)}}});
        return true;
      };
      if (add_colour("r", "g", "b") || add_colour("red", "green", "blue")) continue;
      // Y is of a place where X stands beside it, and of subsampled colours beside RY and BY.
      const bool no_grey = shows.contains("x") || shows.contains("ry") || shows.contains("by") ||
                           is_no_light(last_name_of(name)) || is_no_light(parts[i].part);
      if (!no_grey && add_colour("y", "y", "y")) continue;
      if (parts.size() == 1 && parts[0].channels.size() == 1 && !no_grey && !is_no_light(shows.begin()->first))
        add_colour(shows.begin()->first.c_str(), shows.begin()->first.c_str(), shows.begin()->first.c_str());
    }
  return found;
}

bool has_chroma(const std::vector<ExrPartNames>& parts) {
  for (const ExrPartNames& part : parts)
    for (const auto& [name, shows] : by_layer(part))
      if (shows.contains("y") && shows.contains("ry") && shows.contains("by")) return true;
  return false;
}

std::string listed(const std::vector<Layer>& layers) {
  std::string list;
  for (const Layer& layer : layers)
    list += (list.empty() ? "" : ", ") + (layer.title().empty() ? "one without a name" : layer.title());
  return list.empty() ? "none" : list;
}

std::string listed_channels(const std::vector<ExrPartNames>& parts) {
  std::string list;
  for (const ExrPartNames& part : parts)
    for (const std::string& channel : part.channels)
      list += (list.empty() ? "" : ", ") + (part.part.empty() ? "" : part.part + ": ") + channel;
  return list;
}

/// The only one of which is_meant is true; null where there is none, or more.
template <class IsMeant>
const Layer* only_one(const std::vector<Layer>& layers, IsMeant is_meant) {
  const auto first = std::find_if(layers.begin(), layers.end(), is_meant);
  if (first == layers.end() || std::find_if(first + 1, layers.end(), is_meant) != layers.end()) return nullptr;
  return &*first;
}

ExrColour asked_for(const std::vector<ExrPartNames>& parts, const std::vector<Layer>& layers,
                    const std::string& asked) {
  if (const Layer* const layer = only_one(layers, [&](const Layer& l) { return l.is_called(asked); }))
    return layer->colour;
  std::vector<ExrColour> grey;
  for (size_t i = 0; i < parts.size(); ++i)
    for (const std::string& channel : parts[i].channels)
      if (channel == asked) grey.push_back({i, {channel, channel, channel}});
  if (grey.size() == 1) return grey[0];
  throw InputError("no layer, or more than one, is named '" + asked + "'; its layers of colour are: " + listed(layers) +
                   "; its channels: " + listed_channels(parts));
}

}  // namespace

ExrColour choose_colour(const std::vector<ExrPartNames>& parts, const std::string& layer) {
  const std::vector<Layer> layers = colour_layers(parts);
  if (!layer.empty()) return asked_for(parts, layers, layer);
  if (layers.empty() && has_chroma(parts))
    throw InputError("its colours are luminance and chroma (channels Y, RY and BY): save them as R, G and B");
  if (layers.empty())
    throw InputError("it holds no picture: no layer has the channels R, G and B, or Y alone; it has: " +
                     listed_channels(parts) + "; a channel that is asked for by name is read as grey");
  if (layers.size() == 1) return layers[0].colour;
  if (const Layer* const own = only_one(layers, [](const Layer& l) { return l.name.empty(); })) return own->colour;
  if (const Layer* const combined =
          only_one(layers, [](const Layer& l) { return small_letters(l.last_name()) == "combined"; }))
    return combined->colour;
  throw InputError("it holds more than one picture; ask for one by its name (--layer, or the key 'layer'): " +
                   listed(layers));
}

}  // namespace vpm
