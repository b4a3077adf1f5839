// Sockets that are never waited for without a deadline.
#include "tcp_sender.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <system_error>

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

/// Waits until the socket has room, or an error that its next use tells: 0 then. ETIMEDOUT after the deadline.
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

}  // namespace vpm::tools
