// EXR files come back bit for bit; other people's files are read as the format means them; damaged ones are refused.
#include "vpm/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <bit>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <iterator>

#include "vpm/base/error.h"
#include "vpm/base/rng.h"

namespace vpm {
namespace {

namespace fs = std::filesystem;

/// A picture of random bits: every kind of float, NaNs and infinities too.
Image random_bits(int width, int height, uint64_t index) {
  Rng rng(1, rng_stream(RngUse::test, 0), index);
  Image image(width, height);
  for (Rgb& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) pixel[c] = std::bit_cast<float>(static_cast<uint32_t>(rng.bits()));
  }
  return image;
}

Image noise(int width, int height) {
  Rng rng(2, rng_stream(RngUse::test, 0), 0);
  Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = Rgb(rng.uniform(), rng.uniform(), rng.uniform());
  return image;
}

size_t different_bits(const Image& a, const Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  size_t different = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      different += std::bit_cast<uint32_t>(a.pixels[i][c]) != std::bit_cast<uint32_t>(b.pixels[i][c]);
    }
  }
  return different;
}

class Exr : public testing::Test {
 protected:
  Exr() { fs::create_directory(folder_); }
  ~Exr() override { fs::remove_all(folder_); }

  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& text) const { std::ofstream(file_, std::ios::binary) << text; }

  /// What the InputError of reading file_ says; "" where it is read.
  std::string complaint() const {
    try {
      read_exr(file_);
      read_exr_channels(file_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  /// Writes a file as others might: pixel (x, y) of channel number c is 100 c + 10 y + x.
  void write_foreign(Imf::Header header, const std::vector<std::string>& names, Imf::PixelType type = Imf::FLOAT,
                     int sampling = 1) const {
    const Imath::Box2i window = header.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    const size_t size = type == Imf::HALF ? 2 : 4;
    std::vector<std::vector<char>> planes;
    Imf::FrameBuffer buffer;
    for (size_t c = 0; c < names.size(); ++c) {
      header.channels().insert(names[c], Imf::Channel(type, sampling, sampling));
      std::vector<char>& plane = planes.emplace_back(size * static_cast<size_t>(width * height));
      for (int i = 0; i < width * height; ++i) {
        const int value = 100 * static_cast<int>(c) + 10 * (window.min.y + i / width) + window.min.x + i % width;
        if (type == Imf::HALF) reinterpret_cast<half*>(plane.data())[i] = static_cast<float>(value);
        if (type == Imf::FLOAT) reinterpret_cast<float*>(plane.data())[i] = static_cast<float>(value);
        if (type == Imf::UINT) reinterpret_cast<unsigned*>(plane.data())[i] = static_cast<unsigned>(value);
      }
      const auto base = reinterpret_cast<intptr_t>(plane.data()) -
                        static_cast<intptr_t>(size) * (window.min.x / sampling + window.min.y / sampling * width);
      buffer.insert(names[c], Imf::Slice(type, reinterpret_cast<char*>(base), size, size * static_cast<size_t>(width),
                                         sampling, sampling));
    }
    if (header.hasTileDescription()) {
      Imf::TiledOutputFile out(file_.c_str(), header, 0);
      out.setFrameBuffer(buffer);
      out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
    } else {
      Imf::OutputFile out(file_.c_str(), header, 0);
      out.setFrameBuffer(buffer);
      out.writePixels(height);
    }
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("vpm-exr-test-" + std::to_string(getpid()));
  const fs::path file_ = folder_ / "test.exr";
};

/// As OpenEXR itself reads it, too: no pixel is anywhere else.
TEST_F(Exr, APartOfAPictureIsItsDataWindow) {
  const Image part = noise(5, 3), layer = noise(5, 3);
  write_exr(file_, part, {{"layer", &layer}}, {}, ExrWindow{{4, 6, 9, 9}, 12, 10});
  const ExrChannels whole = read_exr_channels(file_);
  ASSERT_EQ(whole.width, 12);
  ASSERT_EQ(whole.height, 10);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 12; ++x) {
      const bool inside = x >= 4 && x < 9 && y >= 6;
      const auto i = static_cast<size_t>(y * 12 + x);
      EXPECT_EQ(whole.planes.at("G")[i], inside && y < 9 ? part.at(x - 4, y - 6).g : 0.0f);
      EXPECT_EQ(whole.planes.at("layer.B")[i], inside && y < 9 ? layer.at(x - 4, y - 6).b : 0.0f);
    }
  }
  const Imf::InputFile file(file_.c_str());
  EXPECT_EQ(file.header().dataWindow(), Imath::Box2i({4, 6}, {8, 8}));
  EXPECT_EQ(file.header().displayWindow(), Imath::Box2i({0, 0}, {11, 9}));
}

TEST_F(Exr, RoundTripIsExact) {
  const Image radiance = random_bits(67, 45, 0), variance = random_bits(67, 45, 1);
  write_exr(file_, radiance, {{"variance", &variance}},
            {{"vpm:seed", "7"}, {"vpm:scene", "smoke \"ü\"\n"}, {"empty", ""}});
  EXPECT_EQ(different_bits(read_exr(file_), radiance), 0u);

  const ExrChannels channels = read_exr_channels(file_);
  ASSERT_EQ(channels.planes.size(), 7u);  // with A
  EXPECT_EQ(channels.planes.at("A"), std::vector<float>(67 * 45, 1.0f));
  ASSERT_TRUE(layer_of(channels, "variance") && layer_of(channels, ""));
  EXPECT_EQ(different_bits(*layer_of(channels, "variance"), variance), 0u);
  EXPECT_EQ(different_bits(*layer_of(channels, ""), radiance), 0u);
  EXPECT_FALSE(layer_of(channels, "bias"));
  const std::map<std::string, std::string> metadata = {
      {"empty", ""}, {"type", "scanlineimage"}, {"vpm:scene", "smoke \"ü\"\n"}, {"vpm:seed", "7"}};
  EXPECT_EQ(channels.metadata, metadata);
}

TEST_F(Exr, WithoutVarianceThereAreFourChannels) {
  write_exr(file_, noise(1, 1), {}, {});
  EXPECT_EQ(read_exr_channels(file_).planes.size(), 4u);
  EXPECT_EQ(different_bits(read_exr(file_), noise(1, 1)), 0u);
}

TEST_F(Exr, EqualPicturesGiveEqualBytes) {
  const Image image = noise(64, 64);
  write_exr(file_, image, {{"variance", &image}}, {{"a", "1"}, {"b", "2"}});
  const std::string first = bytes();
  write_exr(file_, image, {{"variance", &image}}, {{"b", "2"}, {"a", "1"}});
  EXPECT_EQ(bytes(), first);
  EXPECT_EQ(first.find("capDate"), std::string::npos);
  EXPECT_EQ(first.find("chromaticities"), std::string::npos);
}

TEST_F(Exr, RefusedPath) {
  EXPECT_THROW(write_exr(folder_ / "missing" / "x.exr", noise(2, 2), {}, {}), InputError);
  EXPECT_THROW(write_exr(folder_, noise(2, 2), {}, {}), InputError);
}

TEST_F(Exr, AFullDiskLeavesTheOldFile) {
  write_exr(file_, noise(64, 65), {}, {});
  const rlim_t whole = fs::file_size(file_);
  write_exr(file_, noise(8, 8), {}, {});
  const std::string old = bytes();
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  for (const rlim_t most : {rlim_t{100}, whole / 2, whole - 1}) {  // in the header, the pixels, the last line
    const rlimit small{most, limit.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    EXPECT_THROW(write_exr(file_, noise(64, 65), {}, {}), InputError);
    setrlimit(RLIMIT_FSIZE, &limit);
    EXPECT_EQ(bytes(), old);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
  }
  std::signal(SIGXFSZ, old_handler);
}

TEST_F(Exr, ReadsHalfAndGreyAndTheDefaultLayer) {
  write_foreign(Imf::Header(4, 3), {"B", "G", "R"}, Imf::HALF);
  EXPECT_EQ(read_exr(file_).at(3, 2), Rgb(223.0f, 123.0f, 23.0f));
  write_foreign(Imf::Header(4, 3), {"Y", "A"});
  EXPECT_EQ(read_exr(file_).at(1, 2), Rgb(21.0f));
  write_foreign(Imf::Header(4, 3), {"density"}, Imf::HALF);
  EXPECT_EQ(read_exr(file_).at(1, 2), Rgb(21.0f));
  write_foreign(Imf::Header(4, 3), {"light.B", "light.G", "light.R", "B", "G", "R", "Z"});
  EXPECT_EQ(read_exr(file_).at(0, 0), Rgb(500.0f, 400.0f, 300.0f));
  EXPECT_EQ(read_exr_channels(file_).planes.at("light.G")[5], 111.0f);
}

TEST_F(Exr, ReadsEveryCompressionLineOrderAndTiles) {
  for (const auto compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    for (const auto order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
      Imf::Header header(70, 50, 1, Imath::V2f(0, 0), 1, order, compression);
      write_foreign(header, {"R", "G", "B"});
      EXPECT_EQ(read_exr(file_).at(69, 49), Rgb(559.0f, 659.0f, 759.0f));
      header.setTileDescription(Imf::TileDescription(16, 8));
      header.lineOrder() = Imf::INCREASING_Y;
      write_foreign(header, {"R", "G", "B"});
      EXPECT_EQ(read_exr(file_).at(69, 49), Rgb(559.0f, 659.0f, 759.0f));
    }
  }
}

TEST_F(Exr, HonoursTheDataWindow) {
  using Imath::Box2i;
  using Imath::V2i;
  for (const bool tiled : {false, true}) {
    // display window (10, 20) to (14, 23); the file's pixels start and end elsewhere
    for (const Box2i& data : {Box2i({11, 21}, {13, 22}), Box2i({8, 19}, {20, 30}), Box2i({10, 20}, {14, 23}),
                              Box2i({-5, -7}, {11, 21}), Box2i({30, 40}, {33, 44})}) {
      Imf::Header header(Box2i({10, 20}, {14, 23}), data);
      if (tiled) header.setTileDescription(Imf::TileDescription(4, 4));
      write_foreign(header, {"R", "G", "B"});
      const Image image = read_exr(file_);
      ASSERT_EQ(image.width, 5);
      ASSERT_EQ(image.height, 4);
      for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 5; ++x) {
          const auto value = static_cast<float>(10 * (20 + y) + 10 + x);
          const Rgb expected = data.intersects(V2i(10 + x, 20 + y)) ? Rgb(value, value + 100, value + 200) : Rgb(0.0f);
          EXPECT_EQ(image.at(x, y), expected) << x << " " << y;
        }
      }
    }
  }
}

TEST_F(Exr, RefusesWhatHasNoColour) {
  write_foreign(Imf::Header(4, 4), {"R", "G"});
  EXPECT_NE(complaint().find("it has: G, R"), std::string::npos);
  write_foreign(Imf::Header(4, 4), {"Y", "RY", "BY"});
  EXPECT_NE(complaint().find("luminance and chroma"), std::string::npos);
  write_foreign(Imf::Header(4, 4), {"R", "G", "B"}, Imf::UINT);
  EXPECT_NE(complaint().find("is of integers"), std::string::npos);
  write_foreign(Imf::Header(4, 4), {"R", "G", "B"}, Imf::FLOAT, 2);
  EXPECT_NE(complaint().find("is subsampled"), std::string::npos);
}

TEST_F(Exr, RefusesWhatIsNoExr) {
  EXPECT_NE(complaint().find("there is no such file"), std::string::npos);
  for (const std::string text : {"", "v/1", "\x76\x2f\x31\x01", "not an EXR file, but long enough to be one, almost"}) {
    put(text);
    EXPECT_NE(complaint(), "") << text;
  }
  EXPECT_THROW(read_exr(folder_), InputError);
  EXPECT_THROW(read_exr("/dev/null"), InputError);
}

/// Overwrites the little-endian numbers behind the first `name` in `text`.
void patch(std::string& text, const std::string& name, const std::vector<int32_t>& values) {
  size_t at = text.find(name);
  ASSERT_NE(at, std::string::npos);
  at += name.size();
  for (const int32_t value : values) {
    for (int shift = 0; shift < 32; shift += 8) text[at++] = static_cast<char>(value >> shift);
  }
}

/// Forgets how much memory this process has used so far: tests before may have used more. See proc(5).
void peak_memory_begins() { std::ofstream("/proc/self/clear_refs") << 5; }
/// The most memory it has used since then, in MiB.
long peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss >> 10;
}

TEST_F(Exr, RefusesAbsurdSizesBeforeAllocating) {
  write_exr(file_, noise(8, 8), {}, {{"note", "text"}});
  const std::string good = bytes();
  peak_memory_begins();
  const long before = peak_memory();
  constexpr int32_t kHuge = 0x7fffffff, kHalf = 0x3fffffff - 1;
  const std::vector<int32_t> windows[] = {{0, 0, 70000, 7},       {0, 0, 7, 70000},
                                          {0, 0, 60000, 60000},   {0, 0, kHalf, kHalf},
                                          {-kHalf, -kHalf, 0, 0}, {-kHalf, -kHalf, kHalf, kHalf},
                                          {0, 0, kHuge, kHuge},   {-kHuge - 1, -kHuge - 1, kHuge, kHuge},
                                          {0, 0, -2, -2},         {7, 0, 0, 7}};
  for (const std::string& name :
       {std::string("dataWindow\0box2i\0\x10\0\0\0", 22), std::string("displayWindow\0box2i\0\x10\0\0\0", 25)}) {
    for (const std::vector<int32_t>& window : windows) {
      std::string text = good;
      patch(text, name, window);
      put(text);
      EXPECT_NE(complaint(), "") << name << window[2] << " " << window[3];
    }
  }
  for (const int32_t size : {kHuge, -1, 1 << 20}) {
    std::string text = good;
    patch(text, std::string("note\0string\0", 12), {size});
    put(text);
    EXPECT_NE(complaint().find("longer than the file"), std::string::npos);
  }
  for (const std::string& name : {std::string("box2i\0", 6), std::string("chlist\0", 7), std::string("v2f\0", 4)}) {
    std::string text = good;
    patch(text, name, {12});  // OpenEXR would go on 4 bytes too early and take the values for names and sizes
    put(text);
    EXPECT_NE(complaint().find(name[0] == 'c' ? "the channel list" : "has not the size of a"), std::string::npos)
        << name;
  }
  write_foreign(Imf::Header(Imath::Box2i({0, 0}, {60000, 60000}), Imath::Box2i({0, 0}, {3, 3})), {"Y"});
  EXPECT_NE(complaint().find("need more than 1 GiB"), std::string::npos);
  EXPECT_LT(peak_memory() - before, 100);
}

TEST_F(Exr, RefusesTruncatedFiles) {
  write_exr(file_, noise(40, 40), {}, {{"note", "text"}});
  const std::string good = bytes();
  for (size_t size = 0; size < good.size(); size += size < 400 ? 3 : 997) {
    put(good.substr(0, size));
    EXPECT_NE(complaint(), "") << size;
  }
  put(good);
  EXPECT_EQ(complaint(), "");
}

TEST_F(Exr, DamagedBytesNeverDoMoreThanThrow) {
  const Image image = noise(40, 40);
  write_exr(file_, image, {{"variance", &image}}, {{"note", "text"}});
  const std::string good = bytes();
  Rng rng(3, rng_stream(RngUse::test, 0), 0);
  int refused = 0;
  for (int trial = 0; trial < 600; ++trial) {
    std::string text = good;
    const size_t range = trial % 2 == 0 ? 700 : text.size();  // half of them in the header
    for (int k = 0; k < 1 + trial % 3; ++k) text[rng.bits() % range] = static_cast<char>(rng.bits());
    put(text);
    refused += !complaint().empty();
  }
  EXPECT_GT(refused, 150);
}

}  // namespace
}  // namespace vpm
