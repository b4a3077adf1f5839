// Fields of packets, one after the other.
#include "tev_packets.h"

#include <bit>
#include <cstdint>
#include <utility>

namespace vpm::tools {
namespace {

constexpr int kChannels = 3;

/// The operations that vpm asks for, by their numbers in Ipc.h. Update's third version has channels between each other.
enum class TevOperation : uint8_t { create_image = 4, update_image = 6 };

class TevPacket {
 public:
  TevPacket(TevOperation operation, bool grab_focus, const std::string& name) {
    add(static_cast<uint8_t>(operation));
    add(static_cast<uint8_t>(grab_focus));
    add(name);
  }

  template <class Unsigned>
  void add(Unsigned number) {
    for (size_t i = 0; i < sizeof(number); ++i) bytes_ += static_cast<char>(number >> 8 * i & 0xff);
  }
  void add(int number) { add(static_cast<uint32_t>(number)); }
  void add(float number) { add(std::bit_cast<uint32_t>(number)); }
  void add(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
  void add_channels() {
    add(kChannels);
    for (const char* name : {"R", "G", "B"}) add(std::string(name));
  }

  /// The whole, once all fields are there.
  std::string bytes() && {
    const auto length = static_cast<uint32_t>(bytes_.size());
    for (size_t i = 0; i < sizeof(length); ++i) bytes_[i] = static_cast<char>(length >> 8 * i & 0xff);
    return std::move(bytes_);
  }

 private:
  std::string bytes_ = std::string(sizeof(uint32_t), '\0');  // begins with the length
};

}  // namespace

std::string tev_create_image(const std::string& name, int width, int height) {
  TevPacket packet(TevOperation::create_image, true, name);
  packet.add(width);
  packet.add(height);
  packet.add_channels();
  return std::move(packet).bytes();
}

std::string tev_update_rows(const std::string& name, const Image& picture, int first, int rows) {
  TevPacket packet(TevOperation::update_image, false, name);
  packet.add_channels();
  for (const int number : {0, first, picture.width, rows}) packet.add(number);
  for (int c = 0; c < kChannels; ++c) packet.add(static_cast<uint64_t>(c));          // where a channel begins, floats
  for (int c = 0; c < kChannels; ++c) packet.add(static_cast<uint64_t>(kChannels));  // from pixel to pixel, floats
  for (int y = first; y < first + rows; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < kChannels; ++c) packet.add(picture.at(x, y)[c]);
  return std::move(packet).bytes();
}

}  // namespace vpm::tools
