// Visits: what a grain does at a wall between arriving and leaving.
//
// A visit is a chain of contacts of one grain with one wall. A contact continues a visit if it
// begins before the grain, at the speed with which an earlier contact of the visit released it, has
// gone one spacing of the wall grains. A grain that has not left the reach of a wall of spacing s
// meets the next wall grain within a path of s; one that has left comes back that soon only if
// another grain throws it back immediately. At a smooth wall each contact is a visit.
//
// So each contact has a span, from its beginning to its end plus the time for that path, and the
// visits are the connected unions of the spans of one grain and one wall. They depend on the set of
// contacts only, not on when or in what order these become known. Known contacts are joined to
// pieces of visits, and pieces to larger ones.
#pragma once

#include "engine/contact.hpp"
#include "engine/exact_sum.hpp"
#include "engine/log_histogram.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace riesel {

/// s since step 0
struct Span {
  double begin, end;
};

/// The span of a contact that has ended. The leaving speed is computed from the losses, but at
/// least a tenth of the entry speed; `gravity` (m/s^2) adds to it. `mass` (kg) is that of the
/// grain, `spacing` (m) that of the wall grains, 0 for a smooth wall. The end may be infinite.
Span visit_span(const Contact& contact, double mass, double spacing, double gravity);

/// A piece of a visit: contacts of one grain with one wall whose spans are connected. Its sums are
/// exact, so that pieces can be joined in any order.
struct WallVisit {
  std::int32_t wall;
  std::int32_t grain;
  Span span;
  std::int64_t contacts;
  double entry_rate;              ///< m/s, normal velocity at the beginning of the first contact
  double entry_slip;              ///< m/s, its |slip|
  ExactSum impulse_x, impulse_y;  ///< kg m/s, given to the grain

  /// A single contact.
  WallVisit(const Contact& contact, const Span& its_span);
  WallVisit() = default;

  /// Adds a piece of the same visit.
  void join(const WallVisit& other);
};

/// Sums over visits that are over.
struct VisitTally {
  /// Visits of one contact, of two, ..., of `longest` or more.
  static constexpr std::size_t longest = 8;
  std::array<std::int64_t, longest> of_contacts{};
  std::int64_t contacts = 0;  ///< of all visits
  ExactSum dv_y;              ///< m/s, axial velocity lost
  ExactSum dv_x;              ///< m/s, velocity gained away from the wall
  ExactSum entry_rate;        ///< m/s, normal velocity at the beginning of the first contact
  ExactSum entry_slip;        ///< m/s, its |slip|
  SpeedHistogram entry_rates, entry_slips;

  std::int64_t visits() const;
  /// Adds a visit by a grain of mass `mass` (kg). `away` is the sign of the direction from the wall
  /// into the tube.
  void add(const WallVisit& visit, double mass, double away);
};

}  // namespace riesel
