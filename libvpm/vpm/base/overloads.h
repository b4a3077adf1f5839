// One function object of several, for std::visit: without a generic one among them, the compiler names every kind of a
// variant that none of them takes.
#pragma once

namespace vpm {

template <class... F>
struct Overloads : F... {
  using F::operator()...;
};
template <class... F>
Overloads(F...) -> Overloads<F...>;

}  // namespace vpm
