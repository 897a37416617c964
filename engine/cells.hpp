// The linked-cell grid: sorts the grains by cell, so that a cell is a range of slots.
//
// Cells are numbered row by row, x first. Rows divide the period equally, so that the row of a
// grain follows from its fixed-point y by a multiplication, and they close into a ring. Cells are
// at least as long as the search range, so that all partners of a grain are in its cell and the
// eight around it. To find each pair once, half of these are searched: in sorted order only two
// ranges of slots.
#pragma once

#include "engine/aligned.hpp"
#include "engine/state.hpp"
#include "engine/team_barrier.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

struct SlotRange {
  std::size_t begin, end;

  std::size_t size() const { return end - begin; }
};

/// A multiple of this many slots fills whole cache lines of every array with 4 bytes or more per
/// slot.
inline constexpr std::size_t slots_in_a_line = cache_line / sizeof(std::int32_t);

/// Part number `part` of `slots` slots that are divided into `parts` nearly equal ranges. No two
/// ranges share a cache line of an array, which threads would take from each other.
inline SlotRange part_of(std::size_t slots, std::size_t part, std::size_t parts) {
  const auto end_of = [&](std::size_t count) {
    return count == parts ? slots : slots * count / parts / slots_in_a_line * slots_in_a_line;
  };
  return {end_of(part), end_of(part + 1)};
}

class Cells {
public:
  /// Sorts the grains of `state` by cells of at least `range` (m) in either direction: changes
  /// their slots only. To be called by all members of the team, each with its number; complete when
  /// it returns.
  void sort(State& state, double range, TeamBarrier& team, std::size_t member);
  /// Frees the memory. Nothing but sort() may be called afterwards.
  void forget();

  /// Calls visit(SlotRange) for the ranges of slots to be searched for partners of `slot`: over all
  /// slots, each unordered pair of grains closer than the range of sort() comes up exactly once, if
  /// the period is longer than two such ranges.
  template <class Visit>
  void for_each_later_range(std::size_t slot, Visit visit) const {
    const std::size_t cell = cell_of_slot_[slot];
    const std::size_t row = row_of(slot);
    const std::size_t column = cell - row * columns_;
    const std::size_t left = column == 0 ? 0 : column - 1;
    const std::size_t right = column + 1 == columns_ ? column : column + 1;
    visit(SlotRange{slot + 1, start_[row * columns_ + right + 1]});
    if (rows_ == 1 || (rows_ == 2 && row == 1)) return;  // the ring has no further row
    const std::size_t next = row + 1 == rows_ ? 0 : row + 1;
    visit(SlotRange{start_[next * columns_ + left], start_[next * columns_ + right + 1]});
  }

  std::size_t row_of(std::size_t slot) const { return cell_of_slot_[slot] / columns_; }

  /// Where the grain in `slot` was before the last sort().
  std::size_t old_slot(std::size_t slot) const { return old_slot_[slot]; }

private:
  void lay_out(const State& state, double range);
  double quanta_from_left(Fixed x) const;
  std::uint32_t cell_at(const Grains& grains, std::size_t slot) const;
  void count();
  template <class T>
  void permute(AlignedVector<T>& values, std::size_t member, TeamBarrier& team);
  void permute(AlignedVector<FixedVector>& values, std::size_t member, TeamBarrier& team);
  template <class Values, class Number>
  void permute(Values& values, Number number, std::size_t member, TeamBarrier& team);

  std::size_t columns_ = 1, rows_ = 1;
  Fixed left_edge_ = 0;              // quanta of x
  double columns_per_quantum_ = 0.;  // of x
  std::vector<std::uint32_t> cell_of_slot_;
  std::vector<std::uint32_t> start_;     // first slot of each cell, and one past the last
  std::vector<std::uint32_t> old_slot_;  // of each slot
  // During sort(): first the cells of old slots, then the bits of the values being permuted.
  AlignedVector<std::uint64_t> scratch_;
};

}  // namespace riesel
