// What the ended contacts of a run did, summed since step 0.
//
// They are counts, maxima and exact sums, so that tallies of several threads can be merged in any
// order.
#pragma once

#include "engine/brake.hpp"
#include "engine/contact.hpp"
#include "engine/exact_sum.hpp"
#include "engine/log_histogram.hpp"
#include "engine/wall_visits.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace riesel {

/// One kind of contact: between free grains, or of a grain with a wall.
struct ContactTally {
  std::int64_t begun = 0;
  std::int64_t ended = 0;
  double max_overlap = 0.0;  ///< m
  ExactSum duration;         ///< s
  ExactSum slip_path;        ///< m
  ExactSum normal_loss;      ///< J
  ExactSum friction_loss;    ///< J
  ExactSum energy_won;       ///< J, by those whose losses together are negative
  /// kg m/s, impulse along y on the grains in contact with walls; and the same with each step's
  /// part weighted by the time, as a part of an `era`: the two tell how far the grains have fallen
  /// (work_of_gravity).
  ExactSum impulse_y;
  ExactSum impulse_y_times_time;
  DurationHistogram durations;  ///< of ended contacts
  OverlapHistogram overlaps;    ///< of ended contacts, the largest
  /// One that had max_overlap; none if no contact ended yet.
  std::optional<Contact> deepest;

  /// s, some 34 years. The weighted impulses grow with the square of the time, up to the range of
  /// ExactSum. At the other end they are lost: with grains below some 10 micrometres the work of
  /// gravity, and so the residual of the energy, is wrong.
  static constexpr double era = 0x1p30;

  /// Adds to the sums and to the maximum.
  void add(const Contact& contact);
  void merge(const ContactTally& other);
};

/// How the walls share what they gave to the grains. A tube has two walls: index 0 is the left one.
struct WallImpulses {
  static constexpr std::size_t most_walls = 2;
  std::array<ExactSum, most_walls> y;  ///< kg m/s along y, by wall; together walls.impulse_y
  ExactSum work;                       ///< J, done by walls that move, up to this step

  void add(const Contact& contact) {
    y[static_cast<std::size_t>(contact.name.wall)].add(contact.impulse_y);
  }
  void merge(const WallImpulses& other);
};

struct Tally {
  ContactTally grains;    ///< free grain on free grain
  ContactTally walls;     ///< free grain on wall grain
  WallImpulses impulses;  ///< of these by wall
  /// The same contacts as brakes, and visits to walls that are over: in the tally of a State alone,
  /// where WallWatch counts them.
  BrakeTally brakes;
  VisitTally visits;
  /// What is not yet in `brakes` and `visits`, in any order: WallWatch takes it up when an advance
  /// is over.
  std::vector<Contact> ended_at_walls;

  ContactTally& of(const ContactName& name) { return name.wall == no_wall ? grains : walls; }
  /// Counts a contact that has ended; `reach` (m) is the sum of the radii.
  void end(const Contact& contact, double reach);
  /// Adds what contacts of another slice or part did, which has no brakes and visits.
  void merge(const Tally& other);
};

}  // namespace riesel
