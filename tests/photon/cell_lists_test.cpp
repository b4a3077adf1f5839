// Lists shared by cells: each cell has its own where there are enough, cells near each other never share one, and
// photons of planes and of balls are spread over all of them.
#include "vpm/photon/map/radius_map.h"

#include <set>

#include "support/properties.h"

namespace vpm {
namespace {

TEST(CellLists, EachCellHasItsOwnWhereThereAreEnough) {
  const Vec3i cells(7, 3, 20);
  const CellLists lists(Vec3d(cells), 420.0);
  EXPECT_EQ(lists.number(), 420u);
  EXPECT_EQ(lists.window(), cells);
  size_t next = 0;
  for (int z = 0; z < cells.z; ++z)
    for (int y = 0; y < cells.y; ++y)
      for (int x = 0; x < cells.x; ++x) EXPECT_EQ(lists.list_of({x, y, z}), next++);
}

/// Checks a window of cells anywhere in a grid: that no two share a list, and that rows go on from list to list.
void check_window(const CellLists& lists, const Vec3i& corner) {
  std::set<size_t> taken;
  const Vec3i window = lists.window();
  for (int z = 0; z < window.z; ++z)
    for (int y = 0; y < window.y; ++y) {
      const size_t row = lists.list_of(corner + Vec3i(0, y, z));
      for (int x = 0; x < window.x; ++x) {
        const size_t list = (row + static_cast<size_t>(x)) % lists.number();
        RC_ASSERT(list == lists.list_of(corner + Vec3i(x, y, z)));
        RC_ASSERT(taken.insert(list).second);
      }
    }
}

RC_GTEST_PROP(CellListsProperty, NoTwoCellsOfAWindowShareOne, ()) {
  const auto most = static_cast<size_t>(*magnitude(1.0, 1e6));
  Vec3i cells, corner;
  for (int a = 0; a < 3; ++a) cells[a] = static_cast<int>(*magnitude(1.0, 65537.0));
  const CellLists lists(Vec3d(cells), static_cast<double>(most));
  RC_ASSERT(lists.number() >= 1 && lists.number() <= most);
  if (lists.window() == cells) return;  // a list each
  for (int a = 0; a < 3; ++a) corner[a] = *rc::gen::inRange(0, cells[a]);
  check_window(lists, corner);
}

/// What a cell of a box finds in its list: the mean, over the cells, of how many of them share it.
double sharing(const CellLists& lists, const Vec3i& box) {
  std::vector<double> cells(lists.number());
  for (int z = 0; z < box.z; ++z)
    for (int y = 0; y < box.y; ++y)
      for (int x = 0; x < box.x; ++x) ++cells[lists.list_of(Vec3i(x, y, z) + 30'000)];
  double squares = 0.0;
  for (const double n : cells) squares += n * n;
  return squares / (static_cast<double>(box.x) * box.y * box.z);
}

/// Of planes and cubes of as many cells as there are lists; the worst that was seen is 4.1, of the least number.
TEST(CellLists, PlanesAndCubesSpreadOverAll) {
  for (const double most : {1e4, 5e4, 2.5e5, 1e6}) {
    const CellLists lists(Vec3d(1e5), most);
    const auto side = static_cast<int>(std::sqrt(most)), edge = static_cast<int>(std::cbrt(most));
    for (int across = 0; across < 3; ++across) {
      Vec3i plane(side);
      plane[across] = 1;
      EXPECT_LT(sharing(lists, plane), 5.0) << "across axis " << across << ", " << most << " lists";
    }
    EXPECT_LT(sharing(lists, Vec3i(edge)), 2.0) << most << " lists";
  }
}

}  // namespace
}  // namespace vpm
