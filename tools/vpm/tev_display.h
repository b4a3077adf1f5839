// A picture in the viewer tev, which runs here or on another machine: packets over TCP to a server that may be missing,
// leave or get stuck, none of which may hold up or end the program.
#pragma once

#include <chrono>
#include <stdexcept>
#include <string>

#include "vpm/image/image.h"

namespace vpm::tools {

/// The server does not take what it is sent; the message says why.
class SendError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bytes to a TCP server.
class TcpSender {
 public:
  using Deadline = std::chrono::steady_clock::time_point;

  /// Connects. Throws SendError where that fails, or lasts until after the deadline; the look-up of the host's name is
  /// the system's, and takes what time it takes.
  TcpSender(const std::string& host, const std::string& port, Deadline deadline);
  ~TcpSender();
  TcpSender(const TcpSender&) = delete;
  TcpSender& operator=(const TcpSender&) = delete;

  /// Hands all bytes to the system. Throws SendError where the server has closed the connection, or has not made room
  /// by the deadline: a part may be sent then, and the connection is good for nothing more.
  void send(const std::string& bytes, Deadline deadline) const;

 private:
  int socket_ = -1;
};

// The packets that the viewer tev takes over TCP [Mueller2025, Ipc.h, Ipc.cpp]: a length in bytes, which counts itself,
// an operation, and its fields. Numbers are little-endian, texts end with a 0.

/// Makes a black image with the channels R, G and B, shown at once; it replaces one of that name.
std::string tev_create_image(const std::string& name, int width, int height);

/// Gives `rows` > 0 rows of the picture, from row `first` on, to the image of that name, which is as wide. A packet
/// must be smaller than 4 GiB.
std::string tev_update_rows(const std::string& name, const Image& picture, int first, int rows);

/// Where tev listens; by default where it does without its option --host [Mueller2025, README.md].
struct TevAddress {
  std::string host = "127.0.0.1";
  std::string port = "14158";
};

/// Of "tev" or "tev:HOST:PORT". Throws InputError where the text is anything else.
TevAddress tev_address(const std::string& text);

class TevDisplay {
 public:
  static constexpr int kPatience = 2;  // s that the viewer may take to be connected, and for each picture

  /// Connects, and makes an image of that name and size. Throws SendError where the viewer is not there, or is slower
  /// than kPatience.
  TevDisplay(const TevAddress& address, std::string name, int width, int height);

  /// Shows a picture of that size. Throws SendError where the viewer is gone, or slower than kPatience.
  void show(const Image& picture) const;

 private:
  std::string name_;
  TcpSender sender_;
};

}  // namespace vpm::tools
