// Any bytes as a PNG file: as they are, and with chunks whose checksums are right, past which libpng looks at nothing.
#include "vpm/image/png.h"

#include "fuzz/scratch.h"

namespace vpm {
namespace {

constexpr size_t kSignature = 8, kAroundData = 12;  // bytes: of the file; length, name and checksum of a chunk

uint32_t big_endian(const uint8_t* bytes) {
  return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | bytes[3];
}

/// The checksum of a chunk's name and data [PNG2003, annex D].
uint32_t checksum(const uint8_t* bytes, size_t size) {
  uint32_t sum = ~0u;
  for (size_t i = 0; i < size; ++i) {
    sum ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1u ? 0xedb88320u : 0u);
  }
  return ~sum;
}

std::vector<uint8_t> with_right_checksums(std::vector<uint8_t> file) {
  for (size_t at = kSignature; at + kAroundData <= file.size();) {
    const size_t length = big_endian(&file[at]);
    if (length > file.size() - at - kAroundData) break;
    const uint32_t sum = checksum(&file[at + 4], length + 4);
    for (size_t byte = 0; byte < 4; ++byte) file[at + 8 + length + byte] = uint8_t(sum >> (24 - 8 * byte));
    at += kAroundData + length;
  }
  return file;
}

/// Does the header announce many pixels, though not too many to be read? Such pictures are right and slow.
bool is_slow(const std::vector<uint8_t>& file) {
  constexpr size_t kWidth = kSignature + 8;
  constexpr double kMany = 1 << 16, kTooMany = 1 << 27;
  if (file.size() < kWidth + 8) return false;
  const double pixels = double{1} * big_endian(&file[kWidth]) * big_endian(&file[kWidth + 4]);
  return pixels > kMany && pixels <= kTooMany;
}

}  // namespace
}  // namespace vpm

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::ScratchFolder folder;
  const std::vector<uint8_t> file(data, data + size);
  if (vpm::is_slow(file)) return 0;
  for (const std::vector<uint8_t>& bytes : {file, vpm::with_right_checksums(file)}) {
    const std::string path = folder.put("image.png", bytes.data(), bytes.size());
    for (const vpm::PngValues values : {vpm::PngValues::srgb, vpm::PngValues::linear})
      vpm::read_or_refuse([&] { vpm::read_png(path, values); });
  }
  return 0;
}
