// When a polynomial first comes down to zero: the squared distance of two bodies, less what it is
// when they touch, along straight and parabolic paths.
#pragma once

#include <array>
#include <cmath>
#include <optional>

namespace riesel::bench {

/// c[0] + c[1] t + c[2] t^2 ...
template <std::size_t Terms>
struct Polynomial {
  std::array<double, Terms> c;

  double at(double t) const {
    double value = 0.0;
    for (std::size_t i = Terms; i-- > 0;) value = value * t + c[i];
    return value;
  }
  Polynomial<Terms - 1> derivative() const {
    Polynomial<Terms - 1> result{};
    for (std::size_t i = 1; i < Terms; ++i) result.c[i - 1] = static_cast<double>(i) * c[i];
    return result;
  }
};

/// Some times in increasing order.
template <std::size_t Most>
struct Times {
  std::array<double, Most> t{};
  std::size_t count = 0;

  void add(double time) { t[count++] = time; }
};

/// Where f, which is monotonic from `from` to `to` and has different signs there, is zero.
template <std::size_t Terms>
double zero_between(const Polynomial<Terms>& f, double from, double to) {
  const Polynomial<Terms - 1> slope = f.derivative();
  const bool rises = f.at(to) > 0.0;
  double t = 0.5 * (from + to);
  for (int tries = 0; tries < 100; ++tries) {
    const double value = f.at(t);
    if ((value > 0.0) == rises)
      to = t;
    else
      from = t;
    const double newton = t - value / slope.at(t);
    const double next = newton > from && newton < to ? newton : 0.5 * (from + to);
    if (std::abs(next - t) <= 1e-15 * std::abs(t)) return next;
    t = next;
  }
  return t;
}

template <std::size_t Terms>
Times<Terms - 1> zeros(const Polynomial<Terms>& f, double end);

/// Between which times within [0, end] f is monotonic: 0, where it turns, and `end`.
template <std::size_t Terms>
Times<Terms> turns(const Polynomial<Terms>& f, double end) {
  Times<Terms> result;
  result.add(0.0);
  const Times<Terms - 2> inside = zeros(f.derivative(), end);
  for (std::size_t i = 0; i < inside.count; ++i) result.add(inside.t[i]);
  result.add(end);
  return result;
}

/// Where f changes its sign within [0, end].
template <std::size_t Terms>
Times<Terms - 1> zeros(const Polynomial<Terms>& f, double end) {
  Times<Terms - 1> result;
  if constexpr (Terms == 2) {
    const double t = -f.c[0] / f.c[1];
    if (t > 0.0 && t < end) result.add(t);
  } else {
    const Times<Terms> ends = turns(f, end);
    for (std::size_t i = 1; i < ends.count; ++i) {
      const double from = ends.t[i - 1], to = ends.t[i];
      if ((f.at(from) > 0.0) != (f.at(to) > 0.0)) result.add(zero_between(f, from, to));
    }
  }
  return result;
}

/// The first time within [0, end] at which f falls and is zero or less. Bodies that touch already
/// and move apart do not touch, those that touch and approach do at once: where they are is known
/// up to rounding only.
template <std::size_t Terms>
std::optional<double> first_touch(const Polynomial<Terms>& f, double end) {
  const Times<Terms> ends = turns(f, end);
  for (std::size_t i = 1; i < ends.count; ++i) {
    const double from = ends.t[i - 1], to = ends.t[i];
    const double before = f.at(from), after = f.at(to);
    if (after < before && after <= 0.0) return before > 0.0 ? zero_between(f, from, to) : from;
  }
  return std::nullopt;
}

}  // namespace riesel::bench
