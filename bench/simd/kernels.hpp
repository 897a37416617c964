// The two hottest loops of plain stepping, written once more for libraries of vector types.
//
// engine/pair_search.cpp and engine/contact_kernel.cpp leave it to the compiler to make vectors of
// plain loops. Here the vectors are explicit: each kernel is a template over `Lanes`, the few
// operations that a library must provide. It does, operation by operation, what the engine does
// with where two grains are from each other and how they move; that is gathered here, by vectors,
// while the engine has it in a row. So the bits must be those of the engine, and main.cpp checks
// them.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/encounter.hpp"
#include "engine/pair_search.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace riesel::bench::simd {

/// Candidate pairs to be tested, as find_overlapping() gets them.
struct PairProblem {
  const std::uint32_t *first, *second;
  const float* reach2;
  std::size_t count;
  const std::int32_t *x, *y;
  CoarseUnits units;
};

/// Lasting contacts of two grains each, linear law and capped slip.
/// Arrays of `count` elements; count is a multiple of 8, and what is beyond the contacts has zero
/// reach.
struct ContactProblem {
  const std::int64_t *first,
      *second;  // twice the place in Bodies, whose arrays have x and y in turn
  const double *reach, *reduced_mass, *per_mass_first, *per_mass_second;
  double *end, *overlap, *max_overlap, *elastic_energy, *slip_path, *normal_loss, *friction_loss;
  double *friction_x, *friction_y;  // on the first grain
  Fixed *kick_first_x, *kick_first_y, *kick_second_x, *kick_second_y;
  std::int64_t* flags;
  std::size_t count;
  Bodies bodies;
  StepUnits units;
  LinearLaw law;
  double friction;
};

/// The kernels of one library, compiled for one set of instructions.
struct Way {
  const char* name;
  /// Writes the indices of the pairs that may overlap to `hits`; returns how many.
  std::size_t (*find_pairs)(const PairProblem& problem, std::uint32_t* hits);
  void (*step_contacts)(const ContactProblem& problem);
};

/// The test of engine/pair_search.cpp for one pair.
[[gnu::always_inline]] inline bool may_overlap(std::uint32_t i, std::uint32_t j, float reach2,
                                               const std::int32_t* x, const std::int32_t* y,
                                               CoarseUnits units) {
  return units.square(coarse_difference(x[j], x[i]), coarse_difference(y[j], y[i])) < reach2;
}

/// Sixteen or eight pairs at a time; only those of a vector that has a hit are looked at singly.
template <class Lanes>
std::size_t find_pairs(const PairProblem& p, std::uint32_t* hits) {
  constexpr std::size_t n = Lanes::floats;
  std::uint32_t* hit = hits;
  const auto unit_x = Lanes::all(p.units.x), unit_y = Lanes::all(p.units.y);
  std::size_t k = 0;
  for (; k + n <= p.count; k += n) {
    const auto dx = Lanes::coarse_difference(p.x, p.second + k, p.first + k) * unit_x;
    const auto dy = Lanes::coarse_difference(p.y, p.second + k, p.first + k) * unit_y;
    std::uint64_t bits = Lanes::bits(dx * dx + dy * dy < Lanes::load(p.reach2 + k));
    for (; bits != 0; bits &= bits - 1)
      *hit++ = static_cast<std::uint32_t>(k) + static_cast<std::uint32_t>(std::countr_zero(bits));
  }
  for (; k < p.count; ++k)
    if (may_overlap(p.first[k], p.second[k], p.reach2[k], p.x, p.y, p.units))
      *hit++ = static_cast<std::uint32_t>(k);
  return static_cast<std::size_t>(hit - hits);
}

/// real() of engine/fixed_point.hpp.
template <class Lanes, class Words>
auto real_of(Words bits) {
  const auto upper =
      Lanes::as_reals(Lanes::template shift_right<32>(bits) ^ Lanes::all(0x4530000080000000UL));
  const auto lower =
      Lanes::as_reals((bits & Lanes::all(0xffffffffUL)) | Lanes::all(0x4330000000000000U));
  return (upper - Lanes::all(0x1p84 + 0x1p63 + 0x1p52)) + lower;
}

/// nearest_fixed() of engine/fixed_point.hpp.
template <class Lanes, class Reals>
auto nearest(Reals quanta) {
  const auto shift = Lanes::all(0x1.8p52);
  const auto upper = quanta * Lanes::all(0x1p-26) + shift;
  const auto lower = quanta - (upper - shift) * Lanes::all(0x1p26) + shift;
  const auto origin = Lanes::as_words(shift);
  return Lanes::template shift_left<26>(Lanes::as_words(upper) - origin)
         + (Lanes::as_words(lower) - origin);
}

/// The smaller and the larger, as std::min and std::max choose.
template <class Lanes, class Reals>
auto smaller(Reals a, Reals b) {
  return Lanes::choose(b < a, b, a);
}
template <class Lanes, class Reals>
auto larger(Reals a, Reals b) {
  return Lanes::choose(a < b, b, a);
}

/// touch(), carry_on() and kick_bodies() for the lanes from i on; returns the flags of these.
template <class Lanes>
auto step_lanes(const ContactProblem& c, std::size_t i) {
  const auto all = [](double value) { return Lanes::all(value); };
  const auto difference = [&](const Fixed& of_body_0) {
    return real_of<Lanes>(Lanes::gather(&of_body_0, c.second + i)
                          - Lanes::gather(&of_body_0, c.first + i));
  };
  const FixedVector &position = *c.bodies.position, &displacement = *c.bodies.u,
                    &kick_before = *c.bodies.kick;
  const StepUnits& u = c.units;
  const auto dt = all(u.dt), half = all(0.5);
  const auto half_vx = difference(displacement.x) * all(u.velocity_x);
  const auto half_vy = difference(displacement.y) * all(u.velocity_y);
  const auto x = difference(position.x) * all(u.metre_x);
  const auto y = difference(position.y) * all(u.metre_y);
  const auto vx = half_vx + difference(kick_before.x) * all(0.5 * u.velocity_x);
  const auto vy = half_vy + difference(kick_before.y) * all(0.5 * u.velocity_y);
  const auto reach = Lanes::load(c.reach + i), mass = Lanes::load(c.reduced_mass + i);

  const auto distance2 = x * x + y * y;
  const auto touching = distance2 < reach * reach;
  const auto distance = Lanes::root(distance2);
  const auto per_distance = distance * (all(1.0) / distance2);
  const auto nx = x * per_distance, ny = y * per_distance;
  const auto overlap = reach - distance;
  const auto closing = all(0.0) - (x * vx + y * vy);
  const auto rate = closing * per_distance;
  const auto slip = (vx * ny - vy * nx) + all(0.0);

  const auto elastic = all(c.law.k_n) * overlap;
  const auto damping = all(c.law.gamma_n) * mass * rate;
  const auto first = Lanes::load(c.per_mass_first + i), second = Lanes::load(c.per_mass_second + i);
  const auto depth2 = overlap * (reach + distance);
  const auto straight = closing * closing + (vx * vx + vy * vy) * depth2;
  const auto per_force = distance * (first + second) * depth2;
  const auto root = Lanes::root(straight + per_force * (elastic + damping));
  const auto begins = depth2 < dt * (root + closing), ends = depth2 < dt * (root - closing);
  const auto since = depth2 / (root + closing), until = depth2 / (root - closing);
  const auto kick_time =
      Lanes::choose(begins, since, half * dt) + Lanes::choose(ends, until, half * dt);
  const auto per_dt = all(1.0 / u.dt);
  const auto f_n = elastic + kick_time * (damping * per_dt);
  const auto half_step_slip = half_vx * ny - half_vy * nx;
  const auto limit = all(c.friction) * Lanes::size(f_n);
  const auto stops = Lanes::negative(mass * half_step_slip * per_dt);
  const auto f_s = larger<Lanes>(Lanes::negative(limit), smaller<Lanes>(limit, stops));
  const auto friction_x = all(0.0) - f_s * ny, friction_y = f_s * nx + all(0.0);
  const auto fx = friction_x - f_n * nx, fy = friction_y - f_n * ny;

  const auto zero = all(0.0);
  const auto set = [&](double* member, auto value) {
    Lanes::store(member + i, Lanes::choose(touching, value, Lanes::load(member + i)));
  };
  const auto add = [&](double* member, auto value) {
    Lanes::store(member + i, Lanes::load(member + i) + Lanes::choose(touching, value, zero));
  };
  const auto mean_vx = all(2.0) * half_vx - vx, mean_vy = all(2.0) * half_vy - vy;
  const auto friction_power =
      Lanes::load(c.friction_x + i) * mean_vx + Lanes::load(c.friction_y + i) * mean_vy;
  Lanes::store(c.friction_loss + i, Lanes::load(c.friction_loss + i) + friction_power * dt);
  set(c.friction_x, friction_x);
  set(c.friction_y, friction_y);
  set(c.end, all(u.time) + Lanes::choose(ends, until, dt));
  set(c.overlap, overlap);
  set(c.max_overlap, larger<Lanes>(Lanes::load(c.max_overlap + i), overlap));
  set(c.elastic_energy, half * all(c.law.k_n) * overlap * overlap);
  add(c.slip_path, Lanes::size(slip) * dt);
  add(c.normal_loss, (f_n - elastic) * rate * dt);

  const auto own_x = Lanes::choose(touching, fx, zero), own_y = Lanes::choose(touching, fy, zero);
  auto size = zero;
  const auto kick = [&](Fixed* member, auto force, auto per_mass, double unit) {
    const auto quanta = force * (per_mass * all(unit));
    Lanes::store(member + i, nearest<Lanes>(quanta));
    size = size + Lanes::size(quanta);
  };
  kick(c.kick_first_x, own_x, first, u.kick_x);
  kick(c.kick_first_y, own_y, first, u.kick_y);
  kick(c.kick_second_x, Lanes::negative(own_x), second, u.kick_x);
  kick(c.kick_second_y, Lanes::negative(own_y), second, u.kick_y);
  // Words are chosen as if they were reals: only their bits matter.
  const auto word = [](std::uint64_t bits) { return Lanes::as_reals(Lanes::all(bits)); };
  const auto apart = Lanes::choose(touching, word(0), word(1));
  const auto bad = Lanes::choose(size < all(0x1p62), word(0), word(2));
  return Lanes::as_words(apart) | Lanes::as_words(bad);
}

template <class Lanes>
void step_contacts(const ContactProblem& c) {
  for (std::size_t i = 0; i < c.count; i += Lanes::reals)
    Lanes::store(c.flags + i, step_lanes<Lanes>(c, i));
}

}  // namespace riesel::bench::simd
