// The weights of the techniques that find one path, from sums that sub-paths carry.
//
// Number the vertices of a path from the light, x_0, to the eye, x_k. Let f_i be the density with which a sub-path from
// the light continues to x_i, r_i that with which one from the eye continues to x_i from x_{i+1}: per area on surfaces,
// per volume in media. Connecting x_i to x_{i+1} finds the path with the density
//   C_i = c_i f_0 ... f_i r_{i+1} ... r_k,
// where c_i is how many such connections are made for each light sub-path: C_{-1} is the eye sub-path that runs into
// the light, C_0 the light that is sampled, C_{k-1} the connection to the camera. Merging at x_i finds it with
//   M_i = N m_i f_0 ... f_i r_i ... r_k
// for N light sub-paths and a kernel of the size m_i, with a factor for each sub-path that need not end there. Where
// x_i is the first vertex from the eye that is not specular, m_i holds all kernels, elsewhere only the
// kernels of surfaces and of points in balls. Light that comes straight from a light onto a surface is neither merged
// there nor brought to the camera from there, where lights are sampled: samples of lights have less noise than
// densities say.
//
// A sub-path from the light carries S_i, the sum of all C_j, j < i, and M_j, j <= i, over C_i / c_i. From vertex to
// vertex,
//   S_i = r_i ((c_{i-1} + S_{i-1}) / f_i + N m_i),
// and in the same way from the eye. Of S_{i-1}, at x_i only its last factor r_{i-1} is not known, and of that only the
// density of the direction, which depends on where the path goes on to: this is why Behind has its members. With the
// power heuristic all terms are squared. See [Georgiev2012] for connections and merges on surfaces, and [Krivanek2014]
// for all merges in media, where media are homogeneous. In grids no factor changes, as the transmittance of each leg is
// known exactly.
//
// Where light starts anywhere on a line through a medium that emits, the line counts as the vertex x_0: as parallel
// light, of which f_1 is the density of what arrives at x_1 from all of it (depart_from_medium()).
#pragma once

#include <algorithm>

#include "vpm/integrators/combined/path_vertex.h"
#include "vpm/integrators/combined/technique.h"
#include "vpm/light/emission_density.h"

namespace vpm {

/// What each technique is worth in one pass: how many samples it takes for each light sub-path.
struct TechniqueCounts {
  double connections = 0.0;  // of a vertex of a light sub-path, for each vertex of an eye sub-path; 0: none
  bool light = false;        // are lights sampled, and run into?
  bool run_into = false;     // can some of them be?
  bool each_light = false;   // is each of them sampled at a vertex, or one that is drawn from all?
  double splats = 0.0;       // light sub-paths for each eye sub-path of a pixel; 0: no light tracing
  // The light sub-paths times the sizes of kernels, 1 over the integrals of their squares; 0: not merged.
  double surfaces = 0.0;     // m^2
  double points_3d = 0.0;    // m^3
  double points_2d = 0.0;    // m^2
  double short_beams = 0.0;  // m
  // Do sub-paths from the eye meet others beyond their first vertex that is not specular? If not, they go on from there
  // only to see what lights they run into, and places that chance leads them to are not merged: beyond that vertex, and
  // where a ray from the camera collides, if merges along the whole ray are made.
  bool deep = true;
  float density_floor = 0.0f;  // where a grid is thinner photons are also stored along flights, see ThinParts
  Heuristic heuristic = Heuristic::balance;

  /// Are these merges made at a vertex from the eye, which is the first that is not specular, or not?
  bool merges_surfaces(bool first) const { return surfaces > 0.0 && (first || deep); }
  bool merges_points_3d(bool first) const { return points_3d > 0.0 && (deep || (first && !merges_along_rays())); }
  /// These find all light that merges where sub-paths collide find.
  bool merges_along_rays() const { return points_2d > 0.0 || short_beams > 0.0; }

  /// A density, or a number, as the heuristic weighs it.
  double weigh(double x) const { return heuristic == Heuristic::power ? x * x : x; }
};

/// Of a place of that density in a medium.
Junction junction_in(const TechniqueCounts& counts, const Medium& medium, float density);

/// The density of coming to a place along `direction` through a leg, over that of the direction: 1/m^2 on surfaces,
/// 1/m^3 in media. The mean over channels stands for the mixture that distances are drawn from.
double arrival(const Junction& at, const Vec3& direction, const Leg& leg);

/// The sine of the angle between two directions (unit).
double sine_between(const Vec3& a, const Vec3& b);

/// A sub-path as it leaves a vertex, or its start.
struct Departure {
  Junction from;
  Vec3 point{0.0f};              // m
  Vec3 direction{0.0f};          // unit
  double forward = 1.0;          // the density of the direction, 1/sr; 1 at a specular vertex
  double behind = 0.0;           // the sum over techniques behind the vertex
  double unless_straight = 0.0;  // of merges at the vertex and of light tracing from there, if it is on a surface
  double adjacent = 0.0;         // how many connections are made over the leg to come
  const Light* light = nullptr;  // that this is the start on: connections over the leg sample it
  double place = 1.0;            // the density of emission there, EmissionDensity::place, over the number of samples of
                                 // the light for each start on it
  bool parallel = false;         // does light not spread from here?
  bool from_medium = false;      // is this a start anywhere on the line, in a medium that emits?
  bool camera = false;           // is this the start at the camera?
  // Of merges at a vertex in a medium, of which the leg to come is one of the two:
  bool merges = false;
  bool first = false;  // is the vertex the first from the eye that is not specular?
  SubPath way = SubPath::light;
  Leg arrived;        // the other leg
  double sine = 0.0;  // of the angle between the two
};

/// A start on a light that is chosen with the probability `chosen`, at a point with that normal.
Departure depart_from_light(const TechniqueCounts& counts, const Light& light, double chosen,
                            const EmissionDensity& emission, const Ray& ray, const Vec3& normal);
/// A start in a medium that emits, anywhere on the line over which all that it emits is `arriving`, W/(m^2 sr), where
/// the sub-path goes on. That is as if light came in parallel; how much of it gets there is in its density.
Departure depart_from_medium(const TechniqueCounts& counts, const Light& light, double chosen, const Rgb& arriving,
                             const Ray& ray);
/// A start at the camera, whose directions have the density `forward`, 1/sr.
Departure depart_from_camera(const TechniqueCounts& counts, const Ray& ray, double forward);
/// Goes on from a vertex along `direction` (unit). `first` says whether it is, from the eye, the first vertex that is
/// not specular.
Departure depart(const TechniqueCounts& counts, const PathVertex& at, const Vec3& direction, const Densities& densities,
                 SubPath way, bool first);

/// The leg from a departure to a point, m.
Leg leg_to(const Departure& departure, const Vec3& point, const Rgb& transmittance);

/// How many connections are made over the leg to `at`, not weighed.
double connections_over(const Departure& departure, const Leg& leg, const Junction& at, const Vec3& point);
/// Behind::further of the next vertex, or of any point on the way that a merge takes for one, were its density 1; does
/// a path begin there?
double further_behind(const TechniqueCounts& counts, const Departure& departure, const Leg& leg, bool starts);
/// All that is behind it, were its density 1.
Behind techniques_behind(const TechniqueCounts& counts, const Departure& departure, const Leg& leg, const Junction& at,
                         const Vec3& point);
/// The same, over its density.
Behind arrive(const TechniqueCounts& counts, const Departure& departure, const Leg& leg, const Junction& at,
              const Vec3& point);
/// Sets what is behind a vertex that the departure has come to, over its leg.
void arrive(const TechniqueCounts& counts, const Departure& departure, PathVertex& vertex);
/// The vertex, a surface or a collision, that a flight has ended at, with that transmittance.
PathVertex arrive(const TechniqueCounts& counts, const Scene& scene, const Departure& departure, const Event& event,
                  const PathState& state, const Rgb& passed);

/// How far a leg takes photons for each that collides at its end, m: beams pass where their photons need not collide. 0
/// of legs that are not crossed.
double passing(const Rgb& sigma_t, const Leg& leg);
/// The density of points-3d at a place in a medium, over the densities of its two sub-paths, as the heuristic weighs
/// it; `first` as in depart().
double points_3d_merged(const TechniqueCounts& counts, const Junction& there, bool first);
/// Likewise of all merges there, between a leg from the light, of which passing() is given, and one from the eye, whose
/// directions have that sine.
double merges_in_medium(const TechniqueCounts& counts, const Junction& there, double passing, const Leg& from_eye,
                        double sine, bool first);
double merges_on_surface(const TechniqueCounts& counts, bool first);

/// A density over another one, as a float has room for it: beside so much no share is left, to the last digit.
inline float finite_density(double density) { return static_cast<float>(std::min(density, 1e30)); }

/// The sum of all densities over those of the two sub-paths that meet at a vertex: a merge's share is its own over it.
/// `merges` is the sum of those of merges there, `back_to_light` the density with which the eye's sub-path goes on
/// along the light's, 1/sr, `back_to_eye` the other one.
inline double all_at_merge(const TechniqueCounts& counts, double merges, const Behind& light, double back_to_light,
                           const Behind& eye, double back_to_eye) {
  return merges + light.sum(counts.weigh(back_to_light)) + eye.sum(counts.weigh(back_to_eye));
}

/// The share of the connection of two departures towards each other, or of the light that is sampled. `at_eye` is what
/// is behind the eye's vertex for the light's sub-path, `at_light` the other way round.
double share_of_connection(const TechniqueCounts& counts, const Departure& light, const Behind& at_eye,
                           const Departure& eye, const Behind& at_light);
/// Likewise of an eye's sub-path that runs into the light, where the light's is its start.
double share_of_running_into(const TechniqueCounts& counts, const Departure& light, const Behind& at_eye,
                             const Departure& eye, const Behind& at_light);
/// The share of light tracing in what the light's sub-path, departing for the camera, brings there.
double share_of_splat(const TechniqueCounts& counts, const Behind& at_camera, double camera_density);

}  // namespace vpm
