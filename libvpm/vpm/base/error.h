// What a user did wrong: thrown at the outer edge, printed once, exit status 2.
#pragma once

#include <stdexcept>
#include <string>

namespace vpm {

/// Bad input. The message says where (file:line:column where known), what is wrong and what would be right.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vpm
