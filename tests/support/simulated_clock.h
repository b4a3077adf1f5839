// A clock on which work takes what the test says.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "vpm/base/cancel.h"
#include "vpm/base/clock.h"

namespace vpm {

class SimulatedClock final : public Clock {
 public:
  double seconds() const override { return now_; }

  /// Work of so many seconds, which is given up on the way where an alarm says so.
  void work(double seconds) const {
    const double end = now_ + seconds;
    for (Pending* next = first(); next && next->at <= end; next = first()) {
      now_ = std::max(now_, next->at);
      next->at = next->ring();
      cancellation_point();
    }
    now_ = end;
  }

 protected:
  std::unique_ptr<Alarm> alarm(double at, std::function<double()> ring) const override {
    return std::make_unique<Pending>(*this, at, std::move(ring));
  }

 private:
  struct Pending final : Alarm {
    Pending(const SimulatedClock& of, double time, std::function<double()> rings)
        : clock(of), at(time), ring(std::move(rings)) {
      clock.pending_.push_back(this);
    }
    ~Pending() override { std::erase(clock.pending_, this); }

    const SimulatedClock& clock;
    double at;
    std::function<double()> ring;
  };

  Pending* first() const {
    const auto least = std::min_element(pending_.begin(), pending_.end(),
                                        [](const Pending* a, const Pending* b) { return a->at < b->at; });
    return least == pending_.end() ? nullptr : *least;
  }

  mutable double now_ = 0.0;  // s
  mutable std::vector<Pending*> pending_;
};

/// A clock on which the time of all that is limited is over at once.
class HastyClock final : public Clock {
 public:
  double seconds() const override { return now_; }

 protected:
  std::unique_ptr<Alarm> alarm(double at, std::function<double()> ring) const override {
    now_ = std::max(now_, at);
    ring();
    return nullptr;
  }

 private:
  mutable double now_ = 0.0;  // s
};

}  // namespace vpm
