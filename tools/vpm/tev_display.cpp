// Sockets that are never waited for without a deadline; fields of packets; addresses of viewers, and pictures in
// packets that tev's first buffer holds.
#include "tev_display.h"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <memory>
#include <system_error>
#include <utility>

#include "vpm/base/error.h"

namespace vpm::tools {
namespace {

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

std::string socket_message(int error) { return std::generic_category().message(error); }

Addresses look_up(const std::string& host, const std::string& port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
  if (error == EAI_SYSTEM) throw SendError(socket_message(errno));
  if (error != 0) throw SendError(gai_strerror(error));
  return {found, &freeaddrinfo};
}

/// Waits until the socket has room, or an error that its next use reports: 0 then. ETIMEDOUT after the deadline.
int wait_for_room(int socket, TcpSender::Deadline deadline) {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd room{socket, POLLOUT, 0};
    const int ready = poll(&room, 1, static_cast<int>(std::max<int64_t>(0, left.count())));
    if (ready > 0) return 0;
    if (ready == 0) return ETIMEDOUT;
    if (errno != EINTR) return errno;
  }
}

/// 0, or why there is no connection to that address.
int connect_to(int socket, const addrinfo& address, TcpSender::Deadline deadline) {
  if (connect(socket, address.ai_addr, address.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  if (const int error = wait_for_room(socket, deadline)) return error;
  int error = 0;
  socklen_t size = sizeof(error);
  return getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

}  // namespace

TcpSender::TcpSender(const std::string& host, const std::string& port, Deadline deadline) {
  const Addresses addresses = look_up(host, port);
  int error = 0;
  for (const addrinfo* address = addresses.get(); address; address = address->ai_next) {
    socket_ = socket(address->ai_family, address->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, address->ai_protocol);
    error = socket_ < 0 ? errno : connect_to(socket_, *address, deadline);
    if (error == 0) return;
    if (socket_ >= 0) close(socket_);
  }
  throw SendError(socket_message(error));
}

TcpSender::~TcpSender() { close(socket_); }

void TcpSender::send(const std::string& bytes, Deadline deadline) const {
  for (size_t sent = 0; sent < bytes.size();) {
    const ssize_t n = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n >= 0) {
      sent += static_cast<size_t>(n);
    } else if (errno == EAGAIN) {
      if (const int error = wait_for_room(socket_, deadline)) throw SendError(socket_message(error));
    } else if (errno != EINTR) {
      throw SendError(socket_message(errno));
    }
  }
}

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
