// What a viewer on this machine is sent over TCP: a port that takes connections, and the packets that come.
#pragma once

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <string>
#include <vector>

#include "vpm/image/image.h"

namespace vpm {

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) { EXPECT_GE(number, 0) << std::strerror(errno); }
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }

 private:
  int number_;
};

/// A port of this machine that nobody else has. The system makes connections to it once it listens, also where no one
/// accepts them, and takes what fits into its buffers.
class ViewerPort {
 public:
  ViewerPort() {
    sockaddr_in address = local(0);
    socklen_t size = sizeof(address);
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    number_ = ntohs(address.sin_port);
  }

  void listen(int waiting = 4) const { EXPECT_EQ(::listen(socket_, waiting), 0); }
  /// The same with little room for what no one reads: the system takes but a part of the first picture.
  void listen_with_little_room() const {
    const int bytes = 4096;
    EXPECT_EQ(setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof(bytes)), 0);
    listen();
  }
  /// The next connection; there must be one within 20 s.
  int accept() const {
    pollfd waiting{socket_, POLLIN, 0};
    EXPECT_EQ(poll(&waiting, 1, 20'000), 1) << "nobody connects";
    return accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
  }
  /// Begins a connection from this process.
  void connect_from(int from) const {
    const sockaddr_in address = local(number_);
    EXPECT_TRUE(connect(from, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 ||
                errno == EINPROGRESS);
  }
  /// What --display is told.
  std::string option() const { return fmt::format("tev:127.0.0.1:{}", number_); }

 private:
  static sockaddr_in local(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }

  Descriptor socket_{socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
  int number_ = 0;
};

/// So many bytes, fewer where the sender ends before.
inline std::string receive(int connection, size_t bytes) {
  std::string all(bytes, '\0');
  const ssize_t n = recv(connection, all.data(), bytes, MSG_WAITALL);
  all.resize(n > 0 ? static_cast<size_t>(n) : 0);
  return all;
}

/// All bytes until the sender ends.
inline std::string receive_all(int connection) {
  std::string all;
  for (std::string part = "."; !part.empty(); all += part) part = receive(connection, 1 << 16);
  return all;
}

/// The next packet; empty after the last one.
inline std::string receive_packet(int connection) {
  const std::string head = receive(connection, 4);
  if (head.size() < 4) return "";
  uint32_t length = 0;
  std::memcpy(&length, head.data(), sizeof(length));
  EXPECT_TRUE(length > 4 && length < 1 << 21) << length;
  if (length <= 4) return "";
  return head + receive(connection, length - 4);
}

/// Packets read field by field, as tev's Ipc.cpp does [Mueller2025].
class PacketReader {
 public:
  explicit PacketReader(const std::string& packet) : bytes_(packet) {}

  template <class Number>
  Number number() {
    Number value{};
    EXPECT_LE(at_ + sizeof(value), bytes_.size()) << "the packet is too short";
    std::memcpy(&value, bytes_.data() + at_, std::min(sizeof(value), bytes_.size() - at_));
    at_ = std::min(at_ + sizeof(value), bytes_.size());
    return value;
  }
  std::string text() {
    const std::string found = bytes_.substr(at_, bytes_.find('\0', at_) - at_);
    at_ = std::min(at_ + found.size() + 1, bytes_.size());
    return found;
  }
  size_t left() const { return bytes_.size() - at_; }

 private:
  const std::string& bytes_;
  size_t at_ = 4;  // after the length
};

/// What a viewer shows of the packets that it is sent.
struct ShownInViewer {
  int created = 0, updates = 0;  // updates that end at the lower edge
  int packets = 0;               // all of them
  std::string name;
  Image picture;

  void take(const std::string& packet) {
    ++packets;
    PacketReader fields(packet);
    const int operation = fields.number<char>();
    fields.number<char>();  // grab focus
    const std::string of = fields.text();
    if (operation == 4) {
      ++created;
      name = of;
      const int width = fields.number<int32_t>(), height = fields.number<int32_t>();
      picture = Image(width, height);
    } else {
      EXPECT_EQ(operation, 6);
      EXPECT_EQ(of, name);
      update(fields);
    }
  }

 private:
  void update(PacketReader& fields) {
    ASSERT_EQ(fields.number<int32_t>(), 3);
    for (const char* channel : {"R", "G", "B"}) ASSERT_EQ(fields.text(), channel);
    const int x = fields.number<int32_t>(), y = fields.number<int32_t>();
    const int width = fields.number<int32_t>(), height = fields.number<int32_t>();
    for (const int64_t expected : {0, 1, 2, 3, 3, 3}) ASSERT_EQ(fields.number<int64_t>(), expected);
    ASSERT_EQ(fields.left(), static_cast<size_t>(width) * height * sizeof(Rgb));
    ASSERT_TRUE(x >= 0 && y >= 0 && x + width <= picture.width && y + height <= picture.height);
    for (int row = y; row < y + height; ++row)
      for (int column = x; column < x + width; ++column)
        for (int c = 0; c < 3; ++c) picture.at(column, row)[c] = fields.number<float>();
    if (y + height == picture.height) ++updates;
  }
};

}  // namespace vpm
