// Passes of photons into cells; their moments; a file.
#include "vpm/job/fluence.h"

#include <fmt/format.h>
#include <cmath>
#include <cstring>
#include <limits>

#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/job/forecast.h"
#include "vpm/photon/field_recorder.h"

namespace vpm {
namespace {

constexpr size_t kCellChunk = 1 << 14;
constexpr size_t kBytesOfQuantity = 6 * sizeof(double) + 3 * sizeof(int64_t) + 2 * sizeof(Rgb);  // in each cell

/// Of one quantity over passes, by cell.
struct FieldMoments {
  std::vector<Rgbd> mean, squares;  // squares: of the differences from the mean

  explicit FieldMoments(size_t cells) : mean(cells, Rgbd(0.0)), squares(cells, Rgbd(0.0)) {}
  /// Of pass number `count`, from 1.
  void add(const CellSums& sums, double scale, int count) {
    parallel_for_chunks(mean.size(), kCellChunk, [&](size_t begin, size_t end, size_t) {
      for (size_t cell = begin; cell < end; ++cell) {
        const Rgbd value = scale * sums[cell], step = value - mean[cell];
        mean[cell] += step / static_cast<double>(count);
        squares[cell] += step * (value - mean[cell]);
      }
    });
  }
  std::vector<Rgb> errors(int count) const {
    std::vector<Rgb> errors(mean.size(), Rgb(std::numeric_limits<float>::quiet_NaN()));
    const double number = count;
    for (size_t cell = 0; count > 1 && cell < errors.size(); ++cell)
      errors[cell] = Rgb(glm::sqrt(squares[cell] / (number * (number - 1.0))));
    return errors;
  }
};

void check(const RenderSettings& settings, const CellLattice& lattice, bool flux) {
  check_photon_passes(settings);
  const double bytes = static_cast<double>(lattice.size() * kBytesOfQuantity * (flux ? 5 : 2)),
               most = 0.5 * physical_memory();
  if (bytes > most)
    throw InputError(
        fmt::format("{} x {} x {} cells take {:.3g} GB, and half of this machine's memory is {:.3g} GB: "
                    "ask for fewer",
                    lattice.count.x, lattice.count.y, lattice.count.z, 1e-9 * bytes, 1e-9 * most));
}

double mean_power(const Scene& scene) {
  double power = 0.0;
  for (const Light& light : scene.lights) power += double{mean_channel(light_power(light, entrance_of(scene, light)))};
  if (!(power > 0.0)) throw InputError("no light emits anything: fluence is 0 everywhere");
  return power;
}

}  // namespace

Box default_field_box(const Scene& scene) {
  const Box shapes = scene.geometry.bounds();
  const Vec3 extent = shapes.empty() ? Vec3(0.0f) : shapes.extent();
  return std::min({extent.x, extent.y, extent.z}) > 0.0f ? shapes : scene.bounds;
}

CellLattice about_cubes(const Box& box, int resolution) {
  const Vec3d extent(box.extent());
  const double edge = std::max({extent.x, extent.y, extent.z}) / resolution;
  return {box, glm::max(Vec3i(1), Vec3i(glm::round(extent / edge)))};
}

FluenceField measure_fluence(const Scene& scene, const RenderSettings& settings, const CellLattice& lattice,
                             const PhotonRun& run, bool flux) {
  check(settings, lattice, flux);
  FieldRecorder recorder(scene, lattice, mean_power(scene), flux);
  FieldMoments fluence(lattice.size()), absorbed(lattice.size());
  std::vector<FieldMoments> along(flux ? 3 : 0, FieldMoments(lattice.size()));
  FluenceField field;
  field.lattice = lattice;
  field.grey = scene.grey;
  field.run = run_photon_passes(scene, settings, run, recorder, [&](const Ledger& ledger, int pass) {
    const double scale = 1.0 / (static_cast<double>(ledger.emitted_count) * lattice.volume());
    fluence.add(recorder.lengths(), scale, pass);
    absorbed.add(recorder.absorbed(), scale, pass);
    for (size_t a = 0; a < along.size(); ++a) along[a].add(*recorder.along()[a], scale, pass);
    recorder.clear();
  });
  const auto take = [&](const FieldMoments& moments, std::vector<Rgb>& values, std::vector<Rgb>& errors) {
    values.assign(moments.mean.begin(), moments.mean.end());
    errors = moments.errors(field.run.passes);
  };
  take(fluence, field.fluence, field.fluence_error);
  take(absorbed, field.absorbed, field.absorbed_error);
  for (size_t a = 0; a < along.size(); ++a) take(along[a], field.flux[a], field.flux_error[a]);
  return field;
}

void write_npy(const FluenceField& field, const std::filesystem::path& path) {
  std::vector<const std::vector<Rgb>*> rows{&field.fluence, &field.fluence_error, &field.absorbed,
                                            &field.absorbed_error};
  for (size_t a = 0; a < 3 && !field.flux[a].empty(); ++a)
    rows.insert(rows.end(), {&field.flux[a], &field.flux_error[a]});
  const Vec3i& count = field.lattice.count;
  std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}, {}, {}, 3), }}",
                                   count.x, count.y, count.z, rows.size());
  constexpr size_t kBefore = 10, kAligned = 64;  // bytes: of magic number, version and length; the format's own
  header.append(kAligned - 1 - (kBefore + header.size()) % kAligned, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  for (size_t cell = 0; cell < field.lattice.size(); ++cell)
    for (const auto* row : rows) bytes.append(reinterpret_cast<const char*>(&(*row)[cell]), sizeof(Rgb));
  write_text(path, bytes);
}

}  // namespace vpm
