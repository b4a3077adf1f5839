// Checkpoints: back to the last bit, or refused.
#include "vpm/input/checkpoint.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "fuzz/whole_checkpoint.h"
#include "vpm/base/error.h"
#include "vpm/base/fnv.h"

namespace vpm {
namespace {

namespace fs = std::filesystem;

class Checkpoint : public ::testing::Test {
 protected:
  ~Checkpoint() override { fs::remove(path_); }

  static RenderResult some_result() {
    RenderResult result{Film(3, 2), {}, 1.5, {}};
    for (int pass = 0; pass < 3; ++pass) {
      Image image(3, 2);
      for (size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = Rgb(0.1f, 0.2f, 0.7f) * static_cast<float>(i + 1) / static_cast<float>(pass + 3);
      result.film.add(image, 1.0 / (pass + 1));
    }
    result.statistics.passes = 3;
    result.statistics.ledger.imbalance.add(0.25);
    result.statistics.eye.rays = 18;
    return result;
  }

  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void put(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

  void refuses(const std::string& identity, const std::string& why) const {
    try {
      read_checkpoint(path_, identity);
      FAIL() << "expected: " << why;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  }

  fs::path path_ = fs::path(::testing::TempDir()) /
                   (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".checkpoint");
};

bool same_bits(const std::vector<Rgbd>& a, const std::vector<Rgbd>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Rgbd)) == 0;
}

TEST_F(Checkpoint, ComesBackToTheLastBit) {
  const RenderResult before = some_result();
  write_checkpoint(path_, "a render", before);
  const RenderResult after = read_checkpoint(path_, "a render");
  EXPECT_EQ(after.film.width(), 3);
  EXPECT_EQ(after.film.height(), 2);
  for (size_t h = 0; h < 2; ++h) {
    const PassMoments &a = before.film.halves()[h], &b = after.film.halves()[h];
    EXPECT_EQ(a.passes, b.passes);
    EXPECT_EQ(a.mean_square, b.mean_square);
    EXPECT_EQ(a.square_spread, b.square_spread);
    EXPECT_TRUE(same_bits(a.mean, b.mean));
    EXPECT_TRUE(same_bits(a.squares, b.squares));
    EXPECT_TRUE(same_bits(a.products, b.products));
  }
  EXPECT_EQ(after.seconds, 1.5);
  EXPECT_EQ(after.statistics.passes, 3);
  EXPECT_EQ(after.statistics.ledger.imbalance.mean(), 0.25);
  EXPECT_EQ(after.statistics.eye.rays, 18u);
  EXPECT_TRUE(after.discs.empty());
}

TEST_F(Checkpoint, BringsBackTheRadiiOfPixels) {
  RenderResult before = some_result();
  for (int i = 0; i < 6; ++i) before.discs.push_back({1.0 / (i + 3), i / 7.0});
  write_checkpoint(path_, "a render", before);
  const RenderResult after = read_checkpoint(path_, "a render");
  ASSERT_EQ(after.discs.size(), 6u);
  EXPECT_EQ(std::memcmp(after.discs.data(), before.discs.data(), 6 * sizeof(PixelDisc)), 0);
  EXPECT_TRUE(same_bits(after.film.halves()[1].products, before.film.halves()[1].products));
}

TEST_F(Checkpoint, OfAnotherRenderIsRefused) {
  write_checkpoint(path_, "a render", some_result());
  refuses("another render", "it is of another render");
}

TEST_F(Checkpoint, ThatIsMissingOrDamagedIsRefused) {
  refuses("a render", "there is no such file");
  std::ofstream(path_) << "a text";
  refuses("a render", "it is no checkpoint");
  write_checkpoint(path_, "a render", some_result());
  const uintmax_t size = fs::file_size(path_);
  for (const uintmax_t left : {size - 1, size / 2, uintmax_t{60}}) {
    fs::resize_file(path_, left);
    refuses("a render", "it is damaged or not whole");
  }
  fs::resize_file(path_, size + 8);
  refuses("a render", "it is damaged or not whole");
}

TEST_F(Checkpoint, OfWhichAnyByteIsAnotherIsRefused) {
  write_checkpoint(path_, "a render", some_result());
  const std::string whole = bytes();
  for (size_t at = 0; at < whole.size(); at += 5) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 1 << at % 8);
    put(flipped);
    refuses("a render", "cannot resume from");
  }
}

TEST_F(Checkpoint, WithARightChecksumOfNumbersThatCannotBeIsRefused) {
  write_checkpoint(path_, "a render", some_result());
  std::string content = bytes();
  content.resize(content.size() - 16);
  const size_t numbers = content.find('\n', content.find('\n') + 1) + 1;
  const auto refuses_with = [&](const std::string& changed) {
    Fnv1a hash;
    hash.add(changed);
    put(changed + hash.digits());
    refuses("a render", "its numbers are none that a render writes");
  };
  const auto with = [&](size_t at, int value) {
    std::string changed = content;
    std::memcpy(changed.data() + numbers + at, &value, sizeof value);
    return changed;
  };
  refuses_with(with(0, -3));     // width
  refuses_with(with(0, 4));      // a pixel column too many
  refuses_with(with(4, 0));      // height
  refuses_with(with(16, -1));    // passes of the first half, behind the seconds
  refuses_with(with(56, 1));     // one pixel with a radius of its own, behind the halves
  refuses_with(with(56, 6));     // radii of pixels that are not there
  refuses_with(content + "\n");  // a byte too many
  refuses_with(content.substr(0, numbers + 20));
  RenderResult of_pixels = some_result();
  of_pixels.discs.resize(6);
  write_checkpoint(path_, "a render", of_pixels);
  content = bytes();
  content.resize(content.size() - 16);
  refuses_with(with(56, 5));  // a pixel without a radius among others that have one
}

TEST_F(Checkpoint, SeedsOfTheFuzzTargetAreStillAccepted) {
  int seeds = 0;
  for (const auto& entry : fs::directory_iterator(VPM_SOURCE_DIR "/tests/fuzz/corpus/checkpoint")) {
    std::ifstream file(entry.path(), std::ios::binary);
    put(whole_checkpoint(std::string(std::istreambuf_iterator<char>(file), {})));
    EXPECT_NO_THROW(read_checkpoint(path_, kFuzzIdentity)) << entry.path() << ": write it anew";
    ++seeds;
  }
  EXPECT_GT(seeds, 0);
}

}  // namespace
}  // namespace vpm
