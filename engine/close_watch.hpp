// Pairs that are closer than a grain in contact may stray: nothing can be foreseen of them, and
// they are looked at in every step, side by side, by vector instructions.
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

  /// Watches a pair from the next step on, as the last one. `first` is deflected, `second` may be;
  /// `reach` is the sum of the radii, and beyond a distance of `far` nobody need watch it (m).
  void add(std::uint32_t pair, std::uint32_t first, std::uint32_t second, double reach, double far,
           std::int64_t step);
  /// Pair number i is not watched any more. The last pair gets its number.
  void remove(std::size_t i);
  void clear() { pairs_.clear(); }

  /// Whether each grain of pair number i still is deflected, or flies, as it was when added. If not
  /// the pair is to be removed: for the caller to ask when a grain has been deflected or let go.
  bool holds(std::size_t i) const;

  /// The pairs that touch or are far apart. To be called once in every step, after `deflected` has
  /// moved to it.
  const std::vector<std::uint32_t>& due_in(const StepUnits& units,
                                           const DeflectedGrains& deflected);

private:
  using Due = LaneMasks<std::uint64_t>;
  /// The grains of the pairs, and where the second is if it flies; else it is at 0 and stays there.
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
  AlignedVector<Fixed> rest_x_, rest_y_;  // where the second is if it stands, minus the first
  Due are_due_;                           // in the last step
  std::vector<std::uint32_t> due_;
};

}  // namespace riesel
