#include "engine/cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>

namespace riesel {

void Cells::sort(State& state, double range, TeamBarrier& team, std::size_t member) {
  Grains& grains = state.grains;
  if (member == 0) lay_out(state, range);
  team.arrive_and_wait(member);
  const SlotRange mine = part_of(grains.size(), member, team.members());
  for (std::size_t i = mine.begin; i < mine.end; ++i) scratch_[i] = cell_at(grains, i);
  team.arrive_and_wait(member);
  if (member == 0) count();
  team.arrive_and_wait(member);
  for_each_array_of(grains, [&](auto& array) { permute(array, member, team); });
  team.arrive_and_wait(member);
}

void Cells::forget() {
  for (auto* array : {&cell_of_slot_, &start_, &old_slot_}) give_up(*array);
  give_up(scratch_);
}

void Cells::lay_out(const State& state, double range) {
  const Grains& grains = state.grains;
  left_edge_ = 0;
  double extent = 0.0;
  if (grains.size() > 0) {  // a part of a tube may have none
    const auto [leftmost, rightmost] =
        std::minmax_element(grains.position.begin(), grains.position.end(),
                            [](const FixedVector& a, const FixedVector& b) { return a.x < b.x; });
    left_edge_ = leftmost->x;
    extent = quanta_from_left(rightmost->x);
  }
  const double width = extent * state.box.quantum_x();
  // Where few small grains are in a large box, cells larger than the range keep the number of cells
  // near that of the grains.
  const double enough = 64.0 + 4.0 * static_cast<double>(grains.size());
  const double size = std::max(range, std::sqrt(width * state.box.length / enough));
  const double least_rows = std::min(3.0, state.box.length / range);
  columns_ = static_cast<std::size_t>(std::clamp(width / size, 1.0, enough));
  rows_ = static_cast<std::size_t>(
      std::max(1.0, std::clamp(state.box.length / size, least_rows, enough)));
  columns_per_quantum_ = static_cast<double>(columns_) / std::max(1.0, extent);
  scratch_.resize(grains.size());
}

/// Never negative; right for any two x, even of grains that are about to be reported as lost.
double Cells::quanta_from_left(Fixed x) const {
  return static_cast<double>(static_cast<std::uint64_t>(wrapped_difference(x, left_edge_)));
}

std::uint32_t Cells::cell_at(const Grains& grains, std::size_t slot) const {
  const auto column =
      static_cast<std::size_t>(quanta_from_left(grains.position[slot].x) * columns_per_quantum_);
  const auto row = static_cast<std::size_t>(
      part_of_ring(grains.position[slot].y, static_cast<std::int64_t>(rows_)));
  return static_cast<std::uint32_t>(row * columns_ + std::min(column, columns_ - 1));
}

/// The counting sort itself, by one thread: where the grains of each cell go.
void Cells::count() {
  const std::size_t n = scratch_.size();
  start_.assign(columns_ * rows_ + 1, 0);
  for (const std::uint64_t cell : scratch_) ++start_[cell + 1];
  for (std::size_t cell = 1; cell < start_.size(); ++cell) start_[cell] += start_[cell - 1];

  old_slot_.resize(n);
  cell_of_slot_.resize(n);
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const auto cell = static_cast<std::uint32_t>(scratch_[i]);
    const std::uint32_t slot = next[cell]++;
    old_slot_[slot] = static_cast<std::uint32_t>(i);
    cell_of_slot_[slot] = cell;
  }
}

/// Moves values to their new slots. Each thread copies its part of the new values to scratch_ and
/// writes them when no thread needs the old ones any more. number(value) refers to the number in a
/// value that is moved: of vectors one coordinate at a time.
template <class Values, class Number>
void Cells::permute(Values& values, Number number, std::size_t member, TeamBarrier& team) {
  using T = std::remove_reference_t<decltype(number(values[0]))>;
  using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  const SlotRange mine = part_of(values.size(), member, team.members());
  for (std::size_t i = mine.begin; i < mine.end; ++i)
    scratch_[i] = std::bit_cast<Bits>(number(values[old_slot_[i]]));
  team.arrive_and_wait(member);
  for (std::size_t i = mine.begin; i < mine.end; ++i)
    number(values[i]) = std::bit_cast<T>(static_cast<Bits>(scratch_[i]));
}

template <class T>
void Cells::permute(AlignedVector<T>& values, std::size_t member, TeamBarrier& team) {
  permute(
      values, [](T& value) -> T& { return value; }, member, team);
}

void Cells::permute(AlignedVector<FixedVector>& values, std::size_t member, TeamBarrier& team) {
  permute(
      values, [](FixedVector& value) -> Fixed& { return value.x; }, member, team);
  permute(
      values, [](FixedVector& value) -> Fixed& { return value.y; }, member, team);
}

}  // namespace riesel
