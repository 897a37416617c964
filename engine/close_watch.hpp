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

  /// Watches no pairs any more. From now on those of a slice to which `own_slot` belongs.
  void start_over(std::uint32_t own_slot);

  /// Watches a pair from the next step on. `first` is deflected, `second` may be; `reach` is the
  /// sum of the radii, and beyond a distance of `far` the pair is let go (m).
  void add(std::uint32_t pair, std::uint32_t first, std::uint32_t second, double reach, double far,
           std::int64_t step);

  /// The pairs that touch, are far apart, or of which a grain has been deflected or let go since;
  /// they are not watched any more. To be called in every step, after `deflected` has moved to it.
  const std::vector<std::uint32_t>& due_in(const StepUnits& units,
                                           const DeflectedGrains& deflected);

private:
  using Due = LaneMasks<std::uint64_t>;
  /// The grains of the pairs, and where the second is if it flies.
  struct Columns {
    std::array<AlignedVector<std::int64_t>, 2> slot, place;
    AlignedVector<Fixed> x, y, ux, uy;
    AlignedVector<double> reach2, far2;  // m^2
  };
  template <class Visit>
  void for_each_column(Visit visit);
  void remove(std::size_t i);

  const Courses& courses_;
  std::vector<std::uint32_t> pairs_;
  std::uint32_t own_slot_ = 0;  // for the padding: other slots others may be writing to
  Columns columns_;             // padded to whole blocks
  Due are_due_;                 // in the last step
  std::vector<std::size_t> leaving_;
  std::vector<std::uint32_t> due_;
};

}  // namespace riesel
