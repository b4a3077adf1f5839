// Alternatives measured side by side: all in one run, in rotating order, so that what disturbs the machine disturbs
// all.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vpm::bench {

/// One way to do the work of a comparison.
struct Alternative {
  std::string name;
  std::function<double()> run;  // does all of the work and returns a checksum; empty: not installed here
  double target = 0.0;          // this one's time over ours that we aim at; 0: none
};

enum class Clock { processor, wall };  // wall where alternatives differ in threads

struct Comparison {
  std::string title;
  std::string item;        // that the time is given for
  double items = 1.0;      // that a run deals with
  double tolerance = 0.0;  // relative, of checksums against the first one's
  Clock clock = Clock::processor;
  std::vector<Alternative> alternatives;  // ours first
};

/// Median and quartiles.
struct Spread {
  double low = 0.0, median = 0.0, high = 0.0;
};
Spread spread_of(std::vector<double> values);

class Bench {
 public:
  explicit Bench(int repetitions) : repetitions_(repetitions) {}

  /// Measures, prints a table and keeps the figures.
  void compare(const Comparison& comparison);
  /// Prints a figure that is not a time, and keeps it.
  void note(const std::string& title, double value, const std::string& unit);

  /// Do all checksums agree?
  bool agrees() const { return agrees_; }
  const std::vector<std::string>& json() const { return json_; }  // an object for each comparison and note

 private:
  int repetitions_;
  bool agrees_ = true;
  std::vector<std::string> json_;
};

/// How large problems may be.
struct Sizes {
  size_t photons = 10'000'000;
};

/// A subject of the program: a file of its own.
struct Subject {
  std::string_view name, summary;
  void (*measure)(Bench&, const Sizes&);
};

void measure_lanes(Bench&, const Sizes&);
void measure_lookups(Bench&, const Sizes&);
void measure_flights(Bench&, const Sizes&);
void measure_transmittance(Bench&, const Sizes&);
void measure_radius(Bench&, const Sizes&);
void measure_nearest(Bench&, const Sizes&);
void measure_many_nearest(Bench&, const Sizes&);
void measure_build(Bench&, const Sizes&);
void measure_beams(Bench&, const Sizes&);
void measure_scaling(Bench&, const Sizes&);
void measure_emission(Bench&, const Sizes&);
void measure_scattering(Bench&, const Sizes&);

}  // namespace vpm::bench
