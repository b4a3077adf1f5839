// What a command that fails says, and how its process ends.
#pragma once

#include <exception>
#include <string>

namespace vpm::tools {

inline constexpr int kFailed = 1;  // not the input's fault: no memory, a library gave up
inline constexpr int kBadInput = 2;
inline constexpr int kNoPassFits = 3;     // the time asked for is over, and no pass is finished
inline constexpr int kInterrupted = 130;  // as shells report a process ended by SIGINT

struct Failure {
  int status;
  std::string message;
};
Failure failure_of(const std::exception_ptr& thrown);

}  // namespace vpm::tools
