// Bytes to a TCP server that may be missing, leave or get stuck, none of which may hold up or end the program.
#pragma once

#include <chrono>
#include <stdexcept>
#include <string>

namespace vpm::tools {

/// The server does not take what it is sent; the message says why.
class SendError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

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

}  // namespace vpm::tools
