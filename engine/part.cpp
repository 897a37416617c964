#include "engine/part.hpp"

#include <iterator>

namespace riesel {

Part::Part(State whole, const ContactModel& model, bool by_flights)
    : state_(std::move(whole)), stepper_(state_, model, by_flights) {}

void Part::cut(const State& whole, std::span<const std::unique_ptr<Part>> parts,
               const Extent& extent) {
  state_.step = began_ = whole.step;
  choose(whole.grains, extent);
  gather(whole.grains);
  note_ids(whole.grains.size());
  state_.contacts.clear();
  for (const auto& part : parts)
    std::copy_if(part->contacts_.begin(), part->contacts_.end(),
                 std::back_inserter(state_.contacts),
                 [&](const Contact& contact) { return knows(contact.name); });
}

/// Lists the grains of the part and its margins: the own ones first, then the copies.
void Part::choose(const Grains& all, const Extent& extent) {
  places_.clear();
  places_of_copies_.clear();
  distances_.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::uint64_t distance = extent.distance(all.position[i].y);
    const auto place = static_cast<std::uint32_t>(i);
    if (distance == 0) {
      places_.push_back(place);
    } else if (distance <= extent.margin) {
      places_of_copies_.push_back(place);
      distances_.push_back(distance);
    }
  }
  own_ = places_.size();
  places_.insert(places_.end(), places_of_copies_.begin(), places_of_copies_.end());
}

void Part::gather(const Grains& all) {
  Grains& mine = state_.grains;
  mine.resize(places_.size());
  const auto gather_array = [&](auto member) {
    const auto& from = all.*member;
    auto& to = mine.*member;
    for (std::size_t i = 0; i < places_.size(); ++i) to[i] = from[places_[i]];
  };
  for_each_moving_array(mine, gather_array);
  for_each_lasting_array(gather_array);
}

void Part::note_ids(std::size_t all) {
  rank_.assign(all, not_here);
  is_own_.assign(all, 0);
  for (std::size_t i = 0; i < places_.size(); ++i) rank_[id(i)] = static_cast<std::uint32_t>(i);
  for (std::size_t i = 0; i < own_; ++i) is_own_[id(i)] = 1;
}

bool Part::knows(const ContactName& name) const {
  const auto here = [&](std::int32_t id) {
    return rank_[static_cast<std::size_t>(id)] != not_here;
  };
  return here(name.grain) && (name.wall != no_wall || here(name.partner));
}

void Part::advance(std::int64_t last, Fixed drift) {
  stepper_.start_over(drift);
  stepper_.count_only(is_own_);
  stepper_.advance(last);
  find_slots();
}

void Part::find_slots() {
  slots_.resize(places_.size());
  for (std::size_t slot = 0; slot < slots_.size(); ++slot)
    slots_[rank_[id(slot)]] = static_cast<std::uint32_t>(slot);
}

void Part::write(Grains& next) const {
  for_each_moving_array(state_.grains, [&](auto member) {
    const auto& from = state_.grains.*member;
    auto& to = next.*member;
    for (std::size_t i = 0; i < own_; ++i) to[places_[i]] = from[slots_[i]];
  });
}

bool Part::agrees(const Grains& next, std::uint64_t farthest) const {
  bool same = true;
  for_each_moving_array(state_.grains, [&](auto member) {
    const auto& copies = state_.grains.*member;
    const auto& originals = next.*member;
    for (std::size_t i = own_; i < places_.size(); ++i)
      if (distances_[i - own_] <= farthest)
        same = same && copies[slots_[i]] == originals[places_[i]];
  });
  return same;
}

void Part::accept() {
  stepper_.hand_over(tally_, profile_);
  contacts_.clear();
  stepper_.candidates().for_each_contact([&](const Contact& contact) {
    if (is_own_[static_cast<std::size_t>(contact.name.grain)] != 0) contacts_.push_back(contact);
  });
}

void Part::hand_over(State& whole, Profile& profile) {
  whole.contacts.insert(whole.contacts.end(), contacts_.begin(), contacts_.end());
  contacts_.clear();
  whole.tally.merge(tally_);
  tally_ = {};
  profile.merge(profile_);
  profile_ = Profile();
}

}  // namespace riesel
