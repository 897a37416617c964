#include "engine/border.hpp"

#include "engine/askew.hpp"

#include <algorithm>
#include <utility>

namespace riesel {

namespace {

void sort_and_unite(std::vector<std::uint32_t>& slots) {
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
}

/// Where `slot` is in the border, or the end.
auto find_in(const std::vector<BorderGrain>& border, std::uint32_t slot) {
  const auto found =
      std::lower_bound(border.begin(), border.end(), slot,
                       [](const BorderGrain& g, std::uint32_t s) { return g.slot < s; });
  return found != border.end() && found->slot == slot ? found : border.end();
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
  std::vector<std::uint32_t> slots;
  for_each_before([&](const Announcement& other) {
    for (const std::uint32_t slot : other.foreign)
      if (owns(slot)) slots.push_back(slot);
  });
  sort_and_unite(slots);
  mine().border.clear();
  for (const std::uint32_t slot : slots)
    mine().border.push_back({.slot = slot, .deflected = false, .motion = {}});
}

bool Border::is_foreign(std::uint32_t slot) const {
  return std::binary_search(foreign().begin(), foreign().end(), slot);
}

std::size_t Border::number_of_foreign(std::uint32_t slot) const {
  const auto rank = std::lower_bound(foreign().begin(), foreign().end(), slot) - foreign().begin();
  return slice_.end - slice_.begin + static_cast<std::size_t>(rank);
}

Motion Border::foreign_motion(std::uint32_t slot, std::int64_t step, const Fall& fallen) const {
  Motion m = courses_.motion(slot, step);
  for_each_after([&](const Announcement& other) {
    const auto found = find_in(other.border, slot);
    if (found == other.border.end() || !found->deflected) return;
    m = found->motion;
    if (other.step == step) return;
    m.take_up_kick();
    m.x = wrapped_sum(m.x, wrapped_sum(m.ux, fallen.x));
    m.y = wrapped_sum(m.y, wrapped_sum(m.uy, fallen.y));
  });
  return m;
}

void Border::announce_course(std::uint32_t slot) {
  if (find_in(mine().border, slot) != mine().border.end()) mine().new_courses.push_back(slot);
}

}  // namespace riesel
