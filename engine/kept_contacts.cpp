// How contacts outlive a sorting: those between candidates go on in the slices that have these, the
// others have ended.
#include "engine/candidates.hpp"
#include "engine/contact_loop.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

namespace riesel {

namespace {

/// Index among the pairs of `slice`, which have just been listed, in this order of the two.
std::optional<std::uint32_t> pair_in(const Slice& slice, std::uint32_t first,
                                     std::uint32_t second) {
  const CandidatePairs& pairs = slice.pairs;
  const auto low = std::lower_bound(pairs.first.begin(), pairs.first.end(), first);
  for (auto p = static_cast<std::size_t>(low - pairs.first.begin());
       p < pairs.size() && pairs.first[p] == first; ++p)
    if (pairs.second[p] == second) return static_cast<std::uint32_t>(p);
  return std::nullopt;
}

/// Index among the grains near walls of `slice`, which have just been listed.
std::optional<std::uint32_t> near_wall_in(const Slice& slice, std::uint32_t slot,
                                          std::int32_t wall) {
  const auto& near = slice.near_walls;
  const auto first =
      std::lower_bound(near.begin(), near.end(), slot,
                       [](const NearWall& n, std::uint32_t x) { return n.slot < x; });
  for (auto n = first; n != near.end() && n->slot == slot; ++n)
    if (n->wall == wall) return static_cast<std::uint32_t>(n - near.begin());
  return std::nullopt;
}

/// The slots of the grains of a contact, whose bodies are still those in the store.
ContactSlots slots_of(const Meeting& m) {
  const auto first = static_cast<std::uint32_t>(m.first);
  const auto second = static_cast<std::uint32_t>(m.second);
  return m.turned ? ContactSlots{second, first} : ContactSlots{first, second};
}

/// The slice of `share` that owns `slot`, or nullptr.
Slice* owner_in(std::span<Slice> share, std::uint32_t slot) {
  const auto owner = std::partition_point(share.begin(), share.end(),
                                          [&](const Slice& slice) { return slice.end <= slot; });
  return owner != share.end() && owner->owns(slot) ? &*owner : nullptr;
}

/// Index of the candidate of `slice` that `contact` is, if it is one.
std::optional<std::uint32_t> candidate_in(const Slice& slice, const Contact& contact,
                                          ContactSlots slots) {
  if (contact.name.wall != no_wall) return near_wall_in(slice, slots.grain, contact.name.wall);
  // The first grain of a pair usually has the lower slot, except across the seam.
  const auto [low, high] = std::minmax(slots.grain, slots.partner);
  const auto found = slice.owns(low) ? pair_in(slice, low, high) : std::nullopt;
  return !found && slice.owns(high) ? pair_in(slice, high, low) : found;
}

/// Adds `contact` to those of `mine` if it is one of its candidates.
void keep_one(const State& state, Slice& mine, const Contact& contact, ContactSlots slots) {
  const auto candidate = candidate_in(mine, contact, slots);
  if (!candidate) return;
  const bool of_wall = contact.name.wall != no_wall;
  const Meeting meeting = of_wall ? meeting_at_wall(mine, state, *candidate, contact.name.partner)
                                  : meeting_of_grains(state.grains, mine.pairs.first[*candidate],
                                                      mine.pairs.second[*candidate], *candidate);
  mark_in_contact(mine, meeting);
  (of_wall ? mine.wall_contacts : mine.pair_contacts).add(meeting, contact);
  ++mine.kept;
}

}  // namespace

std::vector<Contact> Candidates::contacts() const {
  std::vector<Contact> all;
  for_each_contact([&](const Contact& contact) { all.push_back(contact); });
  sort_by_name(all);
  return all;
}

void Candidates::set_contacts_aside(Slice& mine) {
  for (LiveContacts* live : {&mine.pair_contacts, &mine.wall_contacts}) {
    for (std::size_t i = 0; i < live->size(); ++i)
      mine.set_aside.add(live->contact(i), slots_of(live->meeting(i)));
    live->clear();
  }
  mine.kept = 0;
}

/// Adds those of `contacts` that belong to slices of `share` to these; `before` has their slots
/// before the sorting.
void Candidates::keep(const State& state, std::span<Slice> share,
                      std::span<const ContactSlots> before,
                      std::span<const Contact> contacts) const {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactSlots slots = after_sorting(before[i]);
    Slice* const one = owner_in(share, slots.grain);
    Slice* const other = owner_in(share, slots.partner);
    if (one != nullptr) keep_one(state, *one, contacts[i], slots);
    if (other != nullptr && other != one) keep_one(state, *other, contacts[i], slots);
  }
}

std::size_t Candidates::kept() const {
  return std::accumulate(slices_.begin(), slices_.end(), std::size_t{0},
                         [](std::size_t sum, const Slice& slice) { return sum + slice.kept; });
}

/// Ends and counts the contacts whose bodies are no candidates any more: of grains so fast that
/// they left their partners by more than the skin in a single step.
void Candidates::end_lost_contacts(const State& state, std::int64_t step) {
  std::size_t set_aside = 0;
  for (const Slice& slice : slices_) set_aside += slice.set_aside.size();
  if (kept() == set_aside) return;
  StepUnits units(state);
  units.move_to(step);
  const auto is_lost = [&](const Contact& contact, ContactSlots slots) {
    return std::none_of(slices_.begin(), slices_.end(), [&](const Slice& slice) {
      return candidate_in(slice, contact, slots).has_value();
    });
  };
  for (Slice& owner : slices_)
    for (std::size_t i = 0; i < owner.set_aside.size(); ++i) {
      Contact& contact = owner.set_aside.contacts[i];
      const ContactSlots slots = after_sorting(owner.set_aside.slots[i]);
      if (!is_lost(contact, slots)) continue;
      const Meeting meeting = meeting_of(contact.name, state, slots);
      add_last_loss(contact, meeting, bodies(state.grains), slip_, units);
      if (owner.counts(contact.name)) owner.tally.end(contact, meeting.reach());
    }
}

}  // namespace riesel
