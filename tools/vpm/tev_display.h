// A picture in the viewer tev, which runs here or on another machine.
#pragma once

#include <string>

#include "tcp_sender.h"
#include "vpm/image/image.h"

namespace vpm::tools {

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
