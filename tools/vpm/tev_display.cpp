// Addresses of viewers; pictures in packets that tev's first buffer holds.
#include "tev_display.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <utility>

#include "tev_packets.h"
#include "vpm/base/error.h"

namespace vpm::tools {
namespace {

constexpr size_t kPacketPixels = (size_t{1} << 20) / sizeof(Rgb);  // 1 MiB: what fits without tev's buffer growing

TcpSender::Deadline viewer_deadline() {
  return std::chrono::steady_clock::now() + std::chrono::seconds(TevDisplay::kPatience);
}

bool is_port(const std::string& text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end && number >= 1 && number <= 65535;
}

}  // namespace

TevAddress tev_address(const std::string& text) {
  const std::string prefix = "tev:";
  if (text == "tev") return {};
  const size_t colon = text.rfind(':');
  if (text.starts_with(prefix) && colon > prefix.size() && is_port(text.substr(colon + 1)))
    return {text.substr(prefix.size(), colon - prefix.size()), text.substr(colon + 1)};
  throw InputError(
      fmt::format("--display '{}': must be tev, or tev:HOST:PORT with a port from 1 to 65535, as in tev:{}:{}", text,
                  TevAddress{}.host, TevAddress{}.port));
}

TevDisplay::TevDisplay(const TevAddress& address, std::string name, int width, int height)
    : name_(std::move(name)), sender_(address.host, address.port, viewer_deadline()) {
  sender_.send(tev_create_image(name_, width, height), viewer_deadline());
}

void TevDisplay::show(const Image& picture) const {
  const TcpSender::Deadline deadline = viewer_deadline();
  const int rows = static_cast<int>(std::max<size_t>(1, kPacketPixels / static_cast<size_t>(picture.width)));
  for (int first = 0; first < picture.height; first += rows)
    sender_.send(tev_update_rows(name_, picture, first, std::min(rows, picture.height - first)), deadline);
}

}  // namespace vpm::tools
