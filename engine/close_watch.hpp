// Pairs that are closer than a grain in contact may be off its course: nothing can be foreseen of
// them, so that vector instructions look at all of them in every step.
#pragma once

#include "engine/aligned.hpp"
#include "engine/courses.hpp"
#include "engine/deflected_grains.hpp"
#include "engine/encounter.hpp"
#include "engine/fixed_point.hpp"
#include "engine/lane_masks.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

class CloseWatch {
public:
  /// Keeps the reference.
  explicit CloseWatch(const Courses& courses) : courses_(courses) {}

  std::size_t size() const { return pairs_.size(); }
  std::uint32_t pair(std::size_t i) const { return pairs_[i]; }

  /// Watches a pair from the step after `step` on; it gets the number size() - 1. The grain in slot
  /// `first` must be deflected, that in `second` may be. The pair becomes due when the distance of
  /// the two is below `reach`, the sum of the radii, or above `far` (m).
  void add(std::uint32_t pair, std::uint32_t first, std::uint32_t second, double reach, double far,
           std::int64_t step);
  /// Pair number i is not watched any more. The last pair gets its number.
  void remove(std::size_t i);
  void clear() { pairs_.clear(); }

  /// Whether each grain of pair number i is still deflected, or flying, as when it was added. If
  /// not, the caller must remove the pair: it has to ask when a grain has been deflected or let go.
  bool holds(std::size_t i) const;

  /// The pairs that are due. Must be called exactly once in every step, after `deflected` has moved
  /// to it.
  const std::vector<std::uint32_t>& due_in(const StepUnits& units,
                                           const DeflectedGrains& deflected);

private:
  using Due = LaneMasks<std::uint64_t>;
  /// By number of the pair: slots and places of its grains, and position and velocity of the second
  /// if it flies; if it is deflected these are 0.
  struct Columns {
    std::array<std::vector<std::uint32_t>, 2> slot;
    std::array<AlignedVector<std::int64_t>, 2> place;
    AlignedVector<Fixed> x, y, ux, uy;
    AlignedVector<double> reach2, far2;  // m^2
  };
  template <class Visit>
  void for_each_column(Visit visit);
  void look_up(const Bodies& bodies);

  const Courses& courses_;
  std::vector<std::uint32_t> pairs_;
  Columns columns_;                       // padded to whole blocks
  AlignedVector<Fixed> rest_x_, rest_y_;  // (second if it is deflected, else 0) minus first
  Due are_due_;                           // in the last step
  std::vector<std::uint32_t> due_;
};

}  // namespace riesel
