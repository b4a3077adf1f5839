// A fingerprint of bytes: other bytes have another one but by a chance of 1 in 2^64. It guards against mistakes, not
// against malice.
#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "vpm/base/cancel.h"

namespace vpm {

/// FNV-1a of 64 bits [Noll2026], 1 to 2 ns a byte.
class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  }
  /// What is left of a stream.
  void add(std::istream& stream) {
    std::vector<char> block(1 << 16);
    while (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0) {
      cancellation_point();
      add({block.data(), static_cast<size_t>(stream.gcount())});
    }
  }
  uint64_t value() const { return hash_; }
  /// 16 hexadecimal digits.
  std::string digits() const {
    std::string text(16, '0');
    for (size_t i = 0; i < text.size(); ++i) text[i] = "0123456789abcdef"[hash_ >> (60 - 4 * i) & 15u];
    return text;
  }

 private:
  uint64_t hash_ = 0xcbf29ce484222325ull;
};

}  // namespace vpm
