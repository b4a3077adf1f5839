// A clock by which everything takes as long: pilots that go by it are the same on any machine.
#pragma once

#include <functional>
#include <memory>

#include "vpm/base/clock.h"

namespace vpm {

class TickingClock final : public Clock {
 public:
  /// s between one look at it and the next.
  explicit TickingClock(double tick) : tick_(tick) {}

  double seconds() const override { return now_ += tick_; }

 protected:
  /// Nothing is given up.
  std::unique_ptr<Alarm> alarm(double, std::function<double()>) const override { return nullptr; }

 private:
  double tick_;
  mutable double now_ = 0.0;
};

}  // namespace vpm
