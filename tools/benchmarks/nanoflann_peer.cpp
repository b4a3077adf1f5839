// nanoflann's kd-tree.
#include "benchmarks/photons.h"

#ifdef VPM_BENCH_NANOFLANN
#include <nanoflann.hpp>

namespace vpm::bench {
namespace {

/// The photons as nanoflann reads them.
struct Points {
  const std::vector<Photon>& photons;

  size_t kdtree_get_point_count() const { return photons.size(); }
  float kdtree_get_pt(size_t i, size_t axis) const { return photons[i].position[static_cast<int>(axis)]; }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

/// What a gather needs of a radius query: a sum, and no list.
struct SumWithin {
  using DistanceType = float;  // nanoflann asks for these since 1.5
  using IndexType = uint32_t;
  float radius2;
  double sum = 0.0;

  void sort() {}
  bool full() const { return true; }
  bool addPoint(float distance2, uint32_t) {
    sum += radius2 - distance2;
    return true;
  }
  float worstDist() const { return radius2; }
};

class NanoflannIndex final : public PointIndex {
 public:
  explicit NanoflannIndex(const std::vector<Photon>& photons) : points_{photons}, tree_(3, points_) {
    tree_.buildIndex();
  }

  double sum_near(std::span<const Vec3> queries, float radius) const override {
    double sum = 0.0;
    for (const Vec3& q : queries) {
      SumWithin within{radius * radius};
      tree_.findNeighbors(within, &q.x, {});
      sum += within.sum;
    }
    return sum;
  }

  double sum_nearest(std::span<const Vec3> queries, uint32_t count) const override {
    std::vector<uint32_t> indices(count);
    std::vector<float> distances2(count);
    double sum = 0.0;
    for (const Vec3& q : queries) {
      tree_.knnSearch(&q.x, count, indices.data(), distances2.data());
      sum += std::sqrt(distances2.back());
    }
    return sum;
  }

 private:
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3, uint32_t>;

  Points points_;
  Tree tree_;
};

}  // namespace

std::unique_ptr<PointIndex> make_nanoflann_index(const std::vector<Photon>& photons) {
  return std::make_unique<NanoflannIndex>(photons);
}

}  // namespace vpm::bench

#else

namespace vpm::bench {
std::unique_ptr<PointIndex> make_nanoflann_index(const std::vector<Photon>&) { return nullptr; }
}  // namespace vpm::bench

#endif
