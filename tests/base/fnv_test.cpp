// The fingerprint of bytes against values that its authors publish.
#include "vpm/base/fnv.h"

#include <gtest/gtest.h>

#include <sstream>

namespace vpm {
namespace {

std::string digits_of(std::string_view bytes) {
  Fnv1a hash;
  hash.add(bytes);
  return hash.digits();
}

TEST(Fnv1a, GivesThePublishedValues) {
  EXPECT_EQ(digits_of(""), "cbf29ce484222325");
  EXPECT_EQ(digits_of("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(digits_of("foobar"), "85944171f73967e8");
}

TEST(Fnv1a, TakesAStreamAsItsBytes) {
  std::string bytes(200'000, '\0');  // several blocks
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i >> 7);
  std::istringstream stream("skipped" + bytes);
  stream.seekg(7);
  Fnv1a hash;
  hash.add(stream);
  EXPECT_EQ(hash.digits(), digits_of(bytes));
}

}  // namespace
}  // namespace vpm
