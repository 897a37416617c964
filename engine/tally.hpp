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
  ExactSum energy_won;       ///< J, gained by those whose total loss is negative
  /// kg m/s, impulse along y given by walls to the grains; and the same with each step's part
  /// weighted by the time in units of `era`. The work of gravity follows from the two
  /// (observables.cpp).
  ExactSum impulse_y;
  ExactSum impulse_y_times_time;
  DurationHistogram durations;  ///< of ended contacts
  OverlapHistogram overlaps;    ///< of ended contacts, the largest
  /// The contact that had max_overlap; none if no contact has ended yet.
  std::optional<Contact> deepest;

  /// s, some 34 years. The unit of the time by which impulses are weighted: their sum grows with
  /// the square of the time and must stay in the range of ExactSum. The price is resolution: with
  /// grains below some 10 micrometres the work of gravity, and so the residual of the energy, is
  /// wrong.
  static constexpr double era = 0x1p30;

  /// Adds a contact to the sums and to the maximum, not to the counts and histograms.
  void add(const Contact& contact);
  void merge(const ContactTally& other);
};

/// What the single walls gave to the grains. Of the two walls of a tube, index 0 is the left one.
struct WallImpulses {
  static constexpr std::size_t most_walls = 2;
  std::array<ExactSum, most_walls> x;  ///< kg m/s across the tube, by wall
  std::array<ExactSum, most_walls> y;  ///< kg m/s along y, by wall; together walls.impulse_y
  ExactSum work;                       ///< J, done by walls that move, up to this step

  void add(const Contact& contact) {
    const auto wall = static_cast<std::size_t>(contact.name.wall);
    x[wall].add(contact.impulse_x);
    y[wall].add(contact.impulse_y);
  }
  void merge(const WallImpulses& other);
};

/// What the steps themselves count, each slice or part for itself.
struct StepTally {
  ContactTally grains;    ///< free grain on free grain
  ContactTally walls;     ///< free grain on wall grain
  WallImpulses impulses;  ///< of these by wall
  /// Ended contacts with walls that WallWatch has not yet seen, in any order: it clears them after
  /// each advance.
  std::vector<Contact> ended_at_walls;

  ContactTally& of(const ContactName& name) { return name.wall == no_wall ? grains : walls; }
  /// Counts a contact that has ended; `reach` (m) is the sum of the radii.
  void end(const Contact& contact, double reach);
  void merge(const StepTally& other);
};

/// That of a whole run, with what WallWatch finds in the contacts that have ended.
struct Tally : StepTally {
  BrakeTally brakes;  ///< ended contacts with walls, judged as brakes
  VisitTally visits;  ///< ended visits to walls
};

}  // namespace riesel
