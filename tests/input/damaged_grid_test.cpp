// Grid files that are none, or are cut or damaged: refused, or harmless.
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#include "input/grid_expectations.h"
#include "input/grid_folder.h"
#include "vpm/base/error.h"
#include "vpm/input/source.h"

namespace vpm {
namespace {

using openvdb::Coord;
using openvdb::DoubleGrid;
using openvdb::FloatGrid;

TEST_F(GridFile, RefusesWhatIsNotAFile) {
  EXPECT_NE(refusal(request()).find("no such file"), std::string::npos);
  GridRequest r = request();
  r.path = folder_.string();
  EXPECT_NE(refusal(r).find("not a file"), std::string::npos);
  std::ofstream(path_) << "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n";
  EXPECT_NE(refusal(request()).find("git-lfs pointer"), std::string::npos);
  std::ofstream(path_) << "density = 1\n";
  EXPECT_NE(refusal(request()).find("not a .vdb file"), std::string::npos);
  std::ofstream(path_).close();
  EXPECT_NE(refusal(request()).find("empty"), std::string::npos);
}

TEST_F(GridFile, NoTruncationIsAccepted) {
  write({random_grid<FloatGrid>(Coord(-3), Coord(12))});
  const std::string bytes = read_whole_file(path_);
  for (size_t length = 0; length < bytes.size(); length += 1 + length / 40) {
    std::ofstream(path_, std::ios::binary) << bytes.substr(0, length);
    EXPECT_THROW(load_grid(request()), InputError) << length << " of " << bytes.size() << " bytes";
    EXPECT_THROW(list_grids(path_), InputError) << length << " of " << bytes.size() << " bytes";
  }
}

TEST_F(GridFile, DamagedBytesAreRefusedOrHarmless) {
  auto plain = random_grid<FloatGrid>(Coord(-3), Coord(12));
  auto half = random_grid<DoubleGrid>(Coord(0), Coord(9));
  half->setName("other");
  half->setSaveFloatAsHalf(true);
  for (const openvdb::GridBase::Ptr& grid : openvdb::GridPtrVec{plain, half})
    grid->setGridClass(openvdb::GRID_UNKNOWN);  // allows zip
  for (const uint32_t compression : {0u, 1u, 2u, 3u, 6u}) {
    openvdb::io::File file(path_);
    file.setCompression(compression);
    file.write(openvdb::GridPtrVec{plain, half});
    const std::string bytes = read_whole_file(path_);
    std::mt19937 random(compression);
    for (int i = 0; i < 40; ++i) {
      std::string damaged = bytes;
      const size_t place =
          i % 2 ? random() % 700 : bytes.size() - 8 - random() % (bytes.size() / 25);  // heading, or leaves
      const uint64_t value = i % 3 == 0 ? ~uint64_t{0} - random() % 100000 : uint64_t{random()} << (random() % 33);
      std::memcpy(damaged.data() + place, &value, i % 4 < 2 ? 4 : 8);
      std::ofstream(path_, std::ios::binary) << damaged;
      for (const std::string name : {"density", "other"}) {
        try {
          const auto grid = load_grid(request(name)).grid;
          EXPECT_TRUE(std::isfinite(grid->max_density()));
        } catch (const InputError&) {
        }
      }
    }
  }
}

TEST_F(GridFile, ATileIsActiveOrNot) {
  auto grid = new_grid<openvdb::FloatGrid>();
  grid->setName("density");
  grid->tree().addTile(3, Coord(0), 1.0f, true);
  write({grid});
  std::string bytes = read_whole_file(path_);
  ASSERT_EQ(bytes.back(), 1);  // the tile is the last thing in the file
  bytes.back() = 63;
  std::ofstream(path_, std::ios::binary) << bytes;
  EXPECT_NE(refusal(request()).find("a tile that is active: 63"), std::string::npos) << refusal(request());
}

TEST_F(GridFile, BlocksThatCannotBeUnpackedAreFoundBeforeOpenVdbMeetsThem) {
  auto grid = random_grid<FloatGrid>(Coord(0), Coord(7));
  grid->setGridClass(openvdb::GRID_UNKNOWN);  // fog volumes are never zipped
  for (const uint32_t compression : {openvdb::io::COMPRESS_ZIP, openvdb::io::COMPRESS_BLOSC}) {
    openvdb::io::File file(path_);
    file.setCompression(compression);
    file.write(openvdb::GridPtrVec{grid});
    std::string bytes = read_whole_file(path_);
    const auto length_at = [&](size_t at) {
      int64_t length;
      std::memcpy(&length, bytes.data() + at, sizeof(length));
      return length;
    };
    // The first packed block belongs to the root's child; its 32768 equal values pack well.
    size_t place = 8;
    const auto is_block = [&](size_t at) {
      uint32_t unpacked;
      std::memcpy(&unpacked, bytes.data() + at + 12, sizeof(unpacked));
      const bool zipped = compression == openvdb::io::COMPRESS_ZIP && bytes[at + 8] == 0x78;
      return length_at(at) > 16 && length_at(at) < 4096 && (zipped || unpacked == 131072);
    };
    while (place + 16 < bytes.size() && !is_block(place)) ++place;
    ASSERT_LT(place + 16, bytes.size());
    const size_t header = compression == openvdb::io::COMPRESS_ZIP ? 2 : 16;
    for (size_t i = header; i < static_cast<size_t>(length_at(place)); ++i) bytes[place + 8 + i] = '\xff';
    std::ofstream(path_, std::ios::binary) << bytes;
    EXPECT_NE(refusal(request()).find("damaged at byte " + std::to_string(place) + ": "), std::string::npos)
        << refusal(request());
  }
}

TEST_F(GridFile, LengthsThatDoNotFitAreFoundBeforeOpenVdbBelievesThem) {
  auto grid = random_grid<FloatGrid>(Coord(0), Coord(7));
  grid->setGridClass(openvdb::GRID_UNKNOWN);  // fog volumes are never zipped
  openvdb::io::File file(path_);
  file.setCompression(openvdb::io::COMPRESS_ZIP);
  file.write(openvdb::GridPtrVec{grid});
  const std::string bytes = read_whole_file(path_);
  // The one leaf is the last thing in the file: the length of its values, negative where packing did not pay, is
  // the one that ends with the file.
  size_t place = bytes.size() - 8;
  const auto length_at = [&](size_t at) {
    int64_t length;
    std::memcpy(&length, bytes.data() + at, sizeof(length));
    return length;
  };
  while (place > 0 && std::abs(length_at(place)) != static_cast<int64_t>(bytes.size() - place - 8)) --place;
  ASSERT_GT(place, 0u);
  for (const int64_t wrong :
       {int64_t{-1} << 26, int64_t{-2047}, int64_t{1} << 40, int64_t{1} << 33, std::numeric_limits<int64_t>::min()}) {
    std::string damaged = bytes;
    std::memcpy(damaged.data() + place, &wrong, sizeof(wrong));
    std::ofstream(path_, std::ios::binary) << damaged;
    EXPECT_NE(refusal(request()).find("damaged at byte"), std::string::npos) << wrong << ": " << refusal(request());
  }
}

}  // namespace
}  // namespace vpm
