// Checkpoints: back to the last bit, or refused.
#include "vpm/job/checkpoint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

#include "fuzz/whole_checkpoint.h"
#include "vpm/base/error.h"
#include "vpm/base/fnv.h"
#include "vpm/base/rng.h"

namespace vpm {
namespace {

namespace fs = std::filesystem;

const Identity kRender{{"render.seed", "1"}, {"integrator.volume.radius", "0.25"}};
const Origin kOrigin{"/fog \xff\\n\nscenes/fog.toml",  // any bytes, as names of files are
                     {"media.fog.name=\"\"\"a\nb\"\"\"", "film.width=4"},
                     true,
                     18'000'000'000'000'000'000u};

class Checkpoint : public ::testing::Test {
 protected:
  ~Checkpoint() override { fs::remove(path_); }

  static RenderResult some_result() {
    RenderResult result{Film(3, 2), {}, 1.5, {}};
    for (int pass = 0; pass < 3; ++pass) {
      Image image(3, 2);
      for (size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = Rgb(0.1f, 0.2f, 0.7f) * static_cast<float>(i + 1) / static_cast<float>(pass + 3);
      result.film.add(pass, image, image);
    }
    result.statistics.passes = 3;
    result.statistics.ledger.imbalance.add(Rgbd(0.25, 0.5, 1.0));
    result.statistics.eye.rays = 18;
    return result;
  }

  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void put(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

  void refuses(const Identity& identity, const std::string& why) const {
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

TEST_F(Checkpoint, ComesBackToTheLastBit) {
  const RenderResult before = some_result();
  write_checkpoint(path_, kRender, kOrigin, before);
  const std::string written = bytes();
  const RenderResult after = read_checkpoint(path_, kRender);
  EXPECT_EQ(after.film.width(), 3);
  EXPECT_EQ(after.film.height(), 2);
  EXPECT_EQ(after.film.passes(), 3);
  EXPECT_EQ(after.film.sums(), before.film.sums());
  EXPECT_EQ(after.seconds, 1.5);
  EXPECT_EQ(after.statistics.ledger.imbalance.mean(), Rgbd(0.25, 0.5, 1.0));
  EXPECT_TRUE(after.discs.empty());
  write_checkpoint(path_, kRender, kOrigin, after);
  EXPECT_TRUE(bytes() == written);
}

TEST_F(Checkpoint, BringsBackEveryCounter) {
  RenderResult before = some_result();
  int counters = 0;
  for_each_counter(before.statistics, [&](const std::string&, auto& number) {
    if constexpr (std::is_arithmetic_v<std::remove_reference_t<decltype(number)>>) number = ++counters;
  });
  EXPECT_GT(counters, 40);
  before.statistics.ledger.escaped = Rgbd(0.5, 0.25, 7.0);
  before.statistics.eye.weights.add(-3.0);
  write_checkpoint(path_, kRender, kOrigin, before);
  const RenderStatistics after = read_checkpoint(path_, kRender).statistics;
  int expected = 0;
  for_each_counter(after, [&](const std::string& name, const auto& number) {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(number)>>) {
      EXPECT_EQ(number, ++expected) << name;
    }
  });
  EXPECT_EQ(after.ledger.escaped, Rgbd(0.5, 0.25, 7.0));
  EXPECT_EQ(after.eye.weights.sum, -3.0);
  EXPECT_EQ(after.eye.weights.largest, 3.0);
}

TEST_F(Checkpoint, BringsBackTheRadiiOfPixels) {
  RenderResult before = some_result();
  for (int i = 0; i < 6; ++i) before.discs.push_back({1.0 / (i + 3), i / 7.0});
  write_checkpoint(path_, kRender, kOrigin, before);
  const RenderResult after = read_checkpoint(path_, kRender);
  ASSERT_EQ(after.discs.size(), 6u);
  EXPECT_EQ(std::memcmp(after.discs.data(), before.discs.data(), 6 * sizeof(PixelDisc)), 0);
  EXPECT_EQ(after.film.sums(), before.film.sums());
}

TEST_F(Checkpoint, BringsBackLayers) {
  RenderResult before = some_result();
  Film layer(3, 2);
  for (int pass = 0; pass < 3; ++pass) {
    Image image(3, 2);
    image.at(1, 1) = Rgb(0.1f, 7.0f, static_cast<float>(pass));
    layer.add(pass, image);
  }
  before.layers = {layer, before.film};
  write_checkpoint(path_, kRender, kOrigin, before);
  const RenderResult after = read_checkpoint(path_, kRender);
  ASSERT_EQ(after.layers.size(), 2u);
  EXPECT_EQ(after.layers[0].sums(), layer.sums());
  EXPECT_EQ(after.layers[1].sums(), before.film.sums());
  before.layers = {Film(3, 2)};  // of no pass
  write_checkpoint(path_, kRender, kOrigin, before);
  refuses(kRender, "its layers.0 is not of the size and the passes of its film");
}

TEST_F(Checkpoint, TellsWhereItsRenderIsReadFrom) {
  write_checkpoint(path_, kRender, kOrigin, some_result());
  const auto [identity, origin, result] = read_checkpoint(path_);
  EXPECT_EQ(identity, kRender);
  EXPECT_EQ(origin, kOrigin);
  EXPECT_EQ(result.film.sums(), some_result().film.sums());
  for (const char* damaged : {"origin 1\nscene=a\\b\n", "origin 1\nseed=-1\n", "origin 1\nauto=1\n", "origin 1\nseed\n",
                              "origin\n", "origins 0\n"}) {
    put("vpm checkpoint of a render\nformat 10\nidentity 0\n" + std::string(damaged));
    refuses({}, "it does not say w");
  }
}

TEST_F(Checkpoint, OfAnotherRenderIsRefused) {
  write_checkpoint(path_, kRender, kOrigin, some_result());
  refuses({{"render.seed", "2"}, {"scene", "fog"}},
          "it is of another render; render on with the options that it began with\n  render.seed: 1 in the checkpoint, "
          "2 asked for\n  integrator.volume.radius: 0.25 in the checkpoint, nothing asked for\n  scene: nothing in the "
          "checkpoint, fog asked for");
  refuses({kRender[1], kRender[0]}, "\n  the same keys stand in another order");
}

/// Of a film whose passes span four decades in each block.
TEST_F(Checkpoint, TakesTheRoomThatIsTold) {
  constexpr int kSide = 128;
  RenderJob job;
  job.scene.camera = make_camera(Vec3(0.0f, 1.0f, 4.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 40.0f, {kSide, kSide});
  RenderResult result = nothing_rendered(job.scene.camera);
  Image image(kSide, kSide);
  for (int pass = 0; pass < 64; ++pass) {
    Rng rng(5, static_cast<uint64_t>(pass), 0);
    for (Rgb& pixel : image.pixels)
      for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(std::pow(10.0, 4.0 * rng.uniform_double() - 2.0));
    result.film.add(pass, image, image);
  }
  write_checkpoint(path_, kRender, kOrigin, result);
  const auto told = static_cast<double>(checkpoint_bytes(job)), taken = static_cast<double>(fs::file_size(path_));
  EXPECT_LE(taken, told);
  EXPECT_GE(taken, 0.5 * told);
}

TEST_F(Checkpoint, ThatIsMissingOrDamagedIsRefused) {
  refuses(kRender, "there is no such file");
  std::ofstream(path_) << "a text";
  refuses(kRender, "it is no checkpoint");
  std::ofstream(path_) << "vpm checkpoint of a render\nformat 10\nidentity 2\nrender.seed=1\n";
  refuses(kRender, "it is damaged or not whole");
  write_checkpoint(path_, kRender, kOrigin, some_result());
  const uintmax_t size = fs::file_size(path_);
  for (const uintmax_t left : {size - 1, size / 2, uintmax_t{60}}) {
    fs::resize_file(path_, left);
    refuses(kRender, "it is damaged or not whole");
  }
  fs::resize_file(path_, size + 8);
  refuses(kRender, "it is damaged or not whole");
}

TEST_F(Checkpoint, OfWhichAnyByteIsAnotherIsRefused) {
  write_checkpoint(path_, kRender, kOrigin, some_result());
  const std::string whole = bytes();
  for (size_t at = 0; at < whole.size(); at += 23) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 1 << at % 8);
    put(flipped);
    refuses(kRender, "cannot go on from");
  }
}

/// A checkpoint's text in which each `what` is another.
std::string with(std::string text, const std::string& what, const std::string& other) {
  const size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), other);
}
template <class T>
std::string bytes_of(T number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

TEST_F(Checkpoint, OfAnotherFormatIsRefused) {
  write_checkpoint(path_, kRender, kOrigin, some_result());
  const std::string content = bytes();
  put(with(content, "format 10\n", "format 11\n"));
  refuses(kRender, "it is written by another format of checkpoints, 11; this program reads 10");
  EXPECT_THROW(checkpoint_identity(path_), InputError);
  put(with(content, "format 10\n", ""));  // as they were before they told it
  refuses(kRender, "it is written by another format of checkpoints, 1; this program reads 10");
}

TEST_F(Checkpoint, WithARightChecksumOfFieldsThatCannotBeIsRefused) {
  RenderResult result = some_result();
  result.discs.resize(6);
  write_checkpoint(path_, kRender, kOrigin, result);
  std::string content = bytes();
  content.resize(content.size() - 16);
  const auto refuses_text = [&](const std::string& changed, const std::string& why) {
    Fnv1a hash;
    hash.add(std::string_view(changed));
    put(changed + hash.digits());
    refuses(kRender, why);
  };
  const auto refuses_with = [&](const std::string& what, const std::string& other, const std::string& why) {
    refuses_text(with(content, what, other), why);
  };
  const std::string width = "film.width i32 1 4\n", passes = "film.passes range 1 8\n";
  refuses_with(width + bytes_of(3), width + bytes_of(-3), "its film has -3 x 2 pixels");
  refuses_with(width + bytes_of(3), width + bytes_of(0x7fffffff), "its film has 2147483647 x 2 pixels");
  refuses_with(width + bytes_of(3), width + bytes_of(30), "its field 'film.values' holds no sums of that many pixels");
  refuses_with(width + bytes_of(3), width + bytes_of(4), "its field 'discs' has 6 numbers for 8 pixels");
  refuses_with(passes + bytes_of(0), passes + bytes_of(3), "its field 'film.passes' holds no ranges in rising order");
  refuses_with(passes + bytes_of(0), passes + bytes_of(-1), "its field 'film.passes' holds no ranges in rising order");
  refuses_with("discs disc 6 ", "discs disc 5 ", "it has bytes that are no field");
  refuses_with("discs disc 6 96\n", "discs disc 7 96\n", "it has bytes that are no field");
  refuses_with("discs disc 6 96\n", "discs disc 12 96\n",
               "its field 'discs' holds disc in 96 bytes where disc of 16 bytes each");
  refuses_with("statistics.eye.shadow_rays", "statistics.eye.shadow", "it has no field 'statistics.eye.shadow_rays'");
  refuses_with("eye.shadow_rays u64", "eye.shadow_rays f64", "holds f64 in 8 bytes where u64 of 8 bytes each");
  refuses_with("statistics.eye.shadow_rays", "statistics.eye.camera_rays",
               "the field 'statistics.eye.camera_rays' twice");
  refuses_text(content + "more u32 1 4\n1234", "it has a field 'more', which this program does not know");
  refuses_text(content + "\n", "it has bytes that are no field");
  refuses_text(content.substr(0, content.size() - 1), "it has bytes that are no field");
  // The first block's words: one that starts nowhere, and more than there are.
  const std::string squares = "film.squares u32 ";
  const size_t at = content.find('\n', content.find(squares)) + 1;
  for (const auto& [offset, number] : {std::pair{0u, 99}, {4u, 1}, {4u, 1 << 30}}) {
    std::string changed = content;
    std::memcpy(changed.data() + at + offset, &number, sizeof number);
    refuses_text(changed, "its field 'film.squares' holds no sums of that many pixels");
  }
}

TEST_F(Checkpoint, OfMoreSumsThanPixelsIsRefused) {
  Image image(30, 2);  // of two blocks of sums, where 3 x 2 pixels have one
  for (Rgb& pixel : image.pixels) pixel = Rgb(1.0f);
  RenderResult result{Film(30, 2), {}, 1.5, {}};
  result.film.add(0, image);
  write_checkpoint(path_, kRender, kOrigin, result);
  const std::string width = "film.width i32 1 4\n";
  std::string content = with(bytes(), width + bytes_of(30), width + bytes_of(3));
  content.resize(content.size() - 16);
  Fnv1a hash;
  hash.add(std::string_view(content));
  put(content + hash.digits());
  refuses(kRender, "its field 'film.values' holds no sums of that many pixels");
}

/// What is refused, and why, of the fuzz target's seeds; all others are accepted.
const std::map<std::string, std::string> kRefusedSeeds{
    {"damaged_end", "it has bytes that are no field"},
    {"damaged_place_of_sums", "its field 'film.corrections.1' holds no sums of that many pixels"},
    {"damaged_passes", "its field 'film.passes' holds no ranges in rising order"},
    {"damaged_sums", "its field 'film.squares' holds no sums of that many pixels"}};

TEST_F(Checkpoint, SeedsOfTheFuzzTargetAreStillAcceptedOrRefused) {
  const fs::path folder = VPM_SOURCE_DIR "/tests/fuzz/corpus/checkpoint";
  const auto seed = [](const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  constexpr const char* kOld = "format_1";  // a whole file, written before files told their format
  put(seed(folder / kOld));
  refuses(kFuzzIdentity, "it is written by another format of checkpoints, 1; this program reads 10; render again");
  int accepted = 0;
  size_t refused = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name == kOld) continue;
    put(whole_checkpoint(seed(entry.path())));
    if (const auto why = kRefusedSeeds.find(name); why != kRefusedSeeds.end()) {
      refuses(kFuzzIdentity, why->second);
      ++refused;
    } else {
      EXPECT_NO_THROW(read_checkpoint(path_, kFuzzIdentity)) << entry.path() << ": write it anew";
      ++accepted;
    }
  }
  EXPECT_GT(accepted, 0);
  EXPECT_EQ(refused, kRefusedSeeds.size());
}

TEST_F(Checkpoint, OfPassesThatAreNotTheFirstGoesOnWithThoseThatAreMissing) {
  RenderResult before{Film(3, 2), {}, 1.5, {}};
  for (const int pass : {0, 1, 4}) before.film.add(pass, Image(3, 2));
  write_checkpoint(path_, kRender, kOrigin, before);
  const RenderResult after = read_checkpoint(path_, kRender);
  EXPECT_EQ(after.film.sums(), before.film.sums());
  EXPECT_EQ(after.film.sums().passes.first_missing(), 2);
}

}  // namespace
}  // namespace vpm
