#include "engine/border.hpp"

#include "engine/askew.hpp"

#include <algorithm>

namespace riesel {

namespace {

void sort_and_unite(std::vector<std::uint32_t>& slots) {
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
}

/// The number of slots below `slot` in `slots`, which are in increasing order.
std::size_t rank_in(const std::vector<std::uint32_t>& slots, std::uint32_t slot) {
  return static_cast<std::size_t>(std::lower_bound(slots.begin(), slots.end(), slot)
                                  - slots.begin());
}

}  // namespace

void Border::find_neighbours(bool slices_are_thick) {
  const std::size_t slices = announcements_.size();
  if (slices_are_thick) {
    const auto [before, after] = PlaceInRing(index_, slices);
    before_ = {before};
    after_ = {after};
    return;
  }
  before_.clear();
  for (std::size_t i = 0; i < slices; ++i)
    if (i != index_) before_.push_back(i);
  after_ = before_;
}

void Border::list_foreign() {
  auto& foreign = mine().foreign;
  foreign.clear();
  for (const std::uint32_t slot : slice_.pairs.second)
    if (!owns(slot)) foreign.push_back(slot);
  sort_and_unite(foreign);
}

void Border::list_border() {
  Announcement& told = mine();
  told.border.clear();
  for_each_before([&](const Announcement& other) {
    for (const std::uint32_t slot : other.foreign)
      if (owns(slot)) told.border.push_back(slot);
  });
  sort_and_unite(told.border);
  told.deflected.assign(told.border.size(), 0);
  told.motions.resize(told.border.size());
}

bool Border::is_foreign(std::uint32_t slot) const {
  return std::binary_search(foreign().begin(), foreign().end(), slot);
}

bool Border::is_at_border(std::uint32_t slot) const {
  return std::binary_search(mine().border.begin(), mine().border.end(), slot);
}

std::size_t Border::number_of_foreign(std::uint32_t slot) const {
  return slice_.end - slice_.begin + rank_in(foreign(), slot);
}

void Border::announce_course(std::uint32_t slot) {
  if (is_at_border(slot)) mine().new_courses.push_back(slot);
}

void Border::announce_motion(const DeflectedGrains& deflected, std::int64_t step) {
  announced_ = step;
  Announcement& told = mine();
  for (std::size_t i = 0; i < told.border.size(); ++i) {
    const std::int32_t place = courses_.place(told.border[i]);
    const bool is_deflected = place != Courses::flying;
    tell_news(told.deflected[i], static_cast<std::uint8_t>(is_deflected));
    if (is_deflected)
      told.motions[i] = deflected.motion(static_cast<DeflectedGrains::Place>(place));
  }
}

Motion Border::foreign_motion(std::uint32_t slot, std::int64_t step,
                              const FixedVector& fallen) const {
  for (const std::size_t i : after_) {
    const Announcement& other = announcements_[i];
    const std::size_t place = rank_in(other.border, slot);
    if (place == other.border.size() || other.border[place] != slot) continue;
    if (other.deflected[place] == 0) break;
    Motion m = other.motions[place];
    if (announced_ == step) return m;
    m.take_up_kick();
    m.position = wrapped_sum(m.position, wrapped_sum(m.u, fallen));
    return m;
  }
  return courses_.motion(slot, step);
}

}  // namespace riesel
