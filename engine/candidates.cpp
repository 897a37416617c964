#include "engine/candidates.hpp"

#include "engine/parabola.hpp"
#include "engine/team.hpp"
#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace riesel {

namespace {

/// If less than this part of the room for displacements is left, sorting anew is cheaper than
/// measuring them again and again.
constexpr double smallest_useful_part = 0.2;

/// While slices are ahead of each other, grains may use up the first part of that room if none
/// becomes more than twice as fast as the fastest; the second part is a reserve in case one does.
constexpr double part_ahead = 0.25, part_in_case = 0.1;

/// With more rows of cells than this between the first and the last grain of each slice, partners
/// are in neighbouring slices only, even of grains that have strayed by the height of a row.
constexpr std::size_t rows_within_reach = 4;

/// (m per step)^2, of the fastest of the grains with these velocities. Takes the larger speed of
/// those with and without the kick, as either may be the next one: in a State the kick is still to
/// be added to u, during plain stepping u has it already.
RIESEL_VECTOR_KERNEL double largest_square(const FixedVector* u, const FixedVector* end,
                                           const FixedVector* kick, Candidates::Speedometer speed) {
  double fastest2 = 0.0;
  for (; u != end; ++u, ++kick) {
    const double without = speed.squared(lanes_of(*u));
    const double with = speed.squared(lanes_of(*u) + lanes_of(*kick));
    fastest2 = std::max({fastest2, without, with});
  }
  return fastest2;
}

/// Number of whole steps in which a body that falls from rest by `fall` (m per step^2) goes no
/// farther than `room` (m).
std::int64_t steps_of_fall(double fall, double room) {
  constexpr double most = 0x1p40;
  const double steps = steps_to_go(room, 0.5 * fall, fall);
  return static_cast<std::int64_t>(std::min(steps * (1.0 - 1e-9), most));
}

double largest(const std::vector<Slice>& slices, double Slice::*member) {
  double most = 0.0;
  for (const Slice& slice : slices) most = std::max(most, slice.*member);
  return most;
}

std::vector<ContactSlots> slots_of_contacts(const State& state) {
  const std::vector<std::size_t> slots = slots_by_id(state.grains);
  std::vector<ContactSlots> all;
  all.reserve(state.contacts.size());
  for (const Contact& contact : state.contacts) all.push_back(contact_slots(contact.name, slots));
  return all;
}

}  // namespace

double largest_reach(const State& state) {
  const double grain = *std::max_element(state.grains.radius.begin(), state.grains.radius.end());
  double partner = grain;
  for (const WallLattice& wall : state.walls) partner = std::max(partner, wall.radius);
  return grain + partner;
}

/// The middle, so that no grain has a large speed relative to it. Differences from the first grain
/// are compared, as velocities in the falling frame may wrap.
Fixed middle_velocity(const Grains& grains) {
  Fixed least = 0, most = 0;
  for (const FixedVector& u : grains.u) {
    const Fixed from_first = wrapped_difference(u.y, grains.u.front().y);
    least = std::min(least, from_first);
    most = std::max(most, from_first);
  }
  const Fixed middle = wrapped_sum(least, wrapped_difference(most, least) / 2);
  return wrapped_sum(grains.u.front().y, middle);
}

Candidates::Candidates(State& state, const SlipLaw& slip, int threads, const Purpose& purpose,
                       std::size_t slices_per_thread)
    : slip_(slip),
      units_(state.box),
      team_(threads),
      slices_(team_.members() * slices_per_thread),
      fall_(fall_per_step(state)) {
  const Grains& grains = state.grains;
  const auto [least, most] = std::minmax_element(grains.radius.begin(), grains.radius.end());
  max_radius_ = *most;
  one_size_ = *least == *most;
  const double reach = largest_reach(state);
  const double diameter = mean_diameter(grains);
  // A pair is listed at a distance of reach plus skin at most, and until the next listing each of
  // the two may go half a skin farther away. The image that was listed must stay the nearest one,
  // or a new course would be compared with another image.
  const double half_period = 0.499 * state.box.length;
  const double longest_skin =
      std::min(half_period - reach, 0.5 * (half_period - 2.0 * max_radius_));
  if (longest_skin < least_skin * diameter)
    throw std::invalid_argument("the period is too short for the nearest image to be unique");
  skin_ = std::min(purpose.skin_per_diameter * diameter, longest_skin);
  steps_to_walls_ = steps_of_fall(std::abs(state.box.metres_x(fall_.x)), 0.5 * skin_);
  for (const WallLattice& wall : state.walls)
    if (!wall.smooth()
        && wall.spacing(state.box) < WallLattice::least_spacing(max_radius_ + wall.radius))
      throw std::invalid_argument("the grains of a wall are too close together");

  for (Slice& slice : slices_) slice.pairs.searched = purpose.searched;
  start_from(state, std::nullopt);
}

void Candidates::start_from(State& state, std::optional<Fixed> drift) {
  given_drift_ = drift;
  for (Slice& slice : slices_) slice.start_over();
  const std::vector<ContactSlots> before = slots_of_contacts(state);
  as_a_team(static_cast<int>(team_.members()), [&](std::size_t member) {
    const std::span<Slice> mine = share(member);
    renew(state, mine, state.step);
    keep(state, mine, before, state.contacts);
  });
  if (kept() < state.contacts.size())
    throw std::invalid_argument("a contact between bodies that are far from each other");
}

double Candidates::rows(const State& state) {
  const Grains& grains = state.grains;
  const double largest = 2.0 * *std::max_element(grains.radius.begin(), grains.radius.end());
  return state.box.length / (largest + plain_stepping.skin_per_diameter * mean_diameter(grains));
}

bool Candidates::in_trouble() const {
  return std::any_of(slices_.begin(), slices_.end(),
                     [](const Slice& slice) { return slice.failed(); });
}

void Candidates::compare_inner_lists(std::span<Slice> share) const {
  InnerPairs::Use all;
  for (const Slice& slice : slices_) {
    const InnerPairs::Use one = slice.inner.use();
    all.tests += one.tests;
    all.worth_listing += one.worth_listing;
  }
  for (Slice& mine : share) mine.inner.heed(all);
}

double Candidates::fastest() const { return std::sqrt(largest(slices_, &Slice::fastest2)); }

void Candidates::count_way_past_walls(Slice& mine, const StepUnits& units) const {
  const auto size = [&](const FixedVector& way) { return std::sqrt(squared_length(way, units)); };
  double of_walls = 0.0;
  if (units.walls_move)
    for (const BodyMotion& wall : units.walls) of_walls = std::max(of_walls, size(wall.u));
  const FixedVector common = wrapped_sum(drift_, units.fallen);
  const double own = std::sqrt(mine.fastest2);
  const auto add = [](double& way, double more) {
    constexpr double up = 1.0 + 0x1p-51;  // rounds up: the sum of many small terms must be a bound
    way = (way + more) * up;
  };
  add(mine.way_past_walls.across, own + size({common.x, 0}));
  add(mine.way_past_walls.any, own + size(common) + of_walls);
}

Candidates::Lead Candidates::lead(std::int64_t wanted) const {
  if (!slices_are_thick_) return {.steps = 1, .way = 0.0};
  const double room = 0.5 * skin_, speed = 2.0 * fastest();
  const double further = std::min(part_ahead * room / speed, static_cast<double>(wanted - 1));
  const std::int64_t steps = 1 + static_cast<std::int64_t>(further);
  const double way = steps > 1 ? speed * static_cast<double>(steps - 1) + part_in_case * room : 0.0;
  return {.steps = steps, .way = way};
}

std::int64_t Candidates::ready_for(State& state, PackedPositions& coarse, std::span<Slice> share,
                                   std::int64_t step, std::int64_t wanted) {
  const Lead ahead = lead(wanted);
  if (largest(slices_, &Slice::gone) + ahead.way > 0.5 * skin_ || step > hold_until_)
    look_again(state, coarse, share, step, ahead.way);
  // The grains may have been sorted since.
  return slices_are_thick_ ? std::clamp<std::int64_t>(hold_until_ - step + 1, 1, ahead.steps) : 1;
}

std::int64_t Candidates::steps_ahead(std::int64_t step, std::int64_t wanted) const {
  const Lead ahead = lead(wanted);
  const double way = largest(slices_, &Slice::gone) + fastest() + ahead.way;
  return way > 0.5 * skin_ ? 0 : std::clamp<std::int64_t>(hold_until_ - step + 1, 0, ahead.steps);
}

/// Measures the true displacements, and sorts anew if too little room is left, or less than grains
/// may go in the steps `ahead` (m).
void Candidates::look_again(State& state, PackedPositions& coarse, std::span<Slice> share,
                            std::int64_t step, double ahead) {
  Profile& profile = share.front().profile;
  profile.begin_build();
  wait(share);
  for (Slice& mine : share) {
    measure_displacements(coarse, mine, step);
    measure_speeds(state, mine);
  }
  wait(share);
  const double room = 0.5 * skin_, left = room - largest(slices_, &Slice::farthest);
  if (left > std::max(smallest_useful_part * room, ahead) && step <= hold_until_) {
    for (Slice& mine : share) mine.gone = mine.farthest;
  } else {
    sort_anew(state, share, step);
    for (const Slice& mine : share) coarse.copy(when_sorted_, mine.begin, mine.end);
    wait(share);
  }
  profile.done_build();
}

void Candidates::sort_anew(State& state, std::span<Slice> share, std::int64_t step) {
  for (Slice& mine : share) {
    set_contacts_aside(mine);
    if (given_drift_) note_wandering(state, mine, step);
  }
  wait(share);  // all grains are at this step
  renew(state, share, step);
  for (const Slice& slice : slices_)
    keep(state, share, slice.set_aside.slots, slice.set_aside.contacts);
  wait(share);
  if (member_with(share) == 0) end_lost_contacts(state, step);
  wait(share);
  for (Slice& mine : share) give_up(mine.set_aside);  // memory that is not needed until next time
}

void Candidates::renew(State& state, std::span<Slice> share, std::int64_t step) {
  cells_.sort(state, range(), team_, member_with(share));
  if (member_with(share) == 0) start_over(state, step);
  wait(share);
  for (std::size_t slot = share.front().begin; slot < share.back().end; ++slot) {
    when_sorted_.x[slot] = upper_half(state.grains.position[slot].x);
    when_sorted_.y[slot] = upper_half(state.grains.position[slot].y);
    new_slot_[cells_.old_slot(slot)] = static_cast<std::uint32_t>(slot);
  }
  wait(share);
  for (Slice& mine : share) {
    list_pairs(state, mine, share.front().close);
    list_near_walls(state, mine);
    list_kicked(state.grains, mine);
    measure_speeds(state, mine);
    mine.gone = 0.0;
    mine.inner.start_over(skin_);
  }
  wait(share);
}

/// Sets what all slices share: which has which slots, and the common motion, which does not count
/// as displacement.
void Candidates::start_over(const State& state, std::int64_t step) {
  const Grains& grains = state.grains;
  when_sorted_.resize(grains.size());
  new_slot_.resize(grains.size());
  for (std::size_t s = 0; s < slices_.size(); ++s) {
    const SlotRange slots = part_of(grains.size(), s, slices_.size());
    slices_[s].begin = slots.begin;
    slices_[s].end = slots.end;
  }
  slices_are_thick_ =
      slices_.size() > 2 && std::all_of(slices_.begin(), slices_.end(), [&](const Slice& slice) {
        return slice.end > slice.begin
               && cells_.row_of(slice.end - 1) - cells_.row_of(slice.begin) > rows_within_reach;
      });
  sorted_at_ = step;
  hold_until_ = step + steps_to_walls_;
  drift_.x = wrapped_difference(0, wrapped_product(step, fall_.x));
  drift_.y = given_drift_ ? *given_drift_ : middle_velocity(grains);  // a part may have no grains
}

/// Finds the pairs within the longest reach plus skin, a few at a time, and keeps those within
/// their own: all of them if all grains have one size.
void Candidates::list_pairs(const State& state, Slice& mine, std::vector<SlotPair>& close) const {
  constexpr std::size_t slots_at_a_time = 1024;
  const Grains& grains = state.grains;
  const float farthest2 = units_.generous_square(range());
  const float longest_reach2 = units_.generous_square(2.0 * max_radius_);
  mine.pairs.clear();
  for (std::size_t begin = mine.begin; begin < mine.end; begin += slots_at_a_time) {
    const SlotRange slots{begin, std::min(begin + slots_at_a_time, mine.end)};
    find_close(cells_, slots, when_sorted_, units_, farthest2, close);
    std::size_t found = mine.pairs.size();
    if (found + close.size() > mine.pairs.capacity()) {
      // Enough for the whole slice if the rest is like the beginning. resize() alone would double
      // the memory.
      const double part =
          static_cast<double>(slots.end - mine.begin) / static_cast<double>(mine.end - mine.begin);
      mine.pairs.reserve(
          static_cast<std::size_t>(1.03 * static_cast<double>(found + close.size()) / part) + 64);
    }
    mine.pairs.resize(found + close.size());
    if (one_size_)
      for (const auto& [i, j] : close) mine.pairs.set(found++, i, j, longest_reach2);
    else
      for (const auto& [i, j] : close) {
        const double reach = grains.radius[i] + grains.radius[j];
        const float square = when_sorted_.squared_distance(i, j, units_);
        // Written in any case, and overwritten by the next pair if it is too far away: no branch
        // that could be mispredicted.
        mine.pairs.set(found, i, j, units_.generous_square(reach));
        found += square < units_.generous_square(reach + skin_) ? 1U : 0U;
      }
    mine.pairs.resize(found);
  }
}

void Candidates::list_near_walls(const State& state, Slice& mine) const {
  const double room_for_fall = fall_.x != 0 ? 0.5 * skin_ : 0.0;
  mine.near_walls.clear();
  mine.way_past_walls = {};
  for (std::size_t i = mine.begin; i < mine.end; ++i) {
    const double x = state.box.metres_x(state.grains.position[i].x);
    if (std::abs(x - 0.5 * state.box.width) > 1.5 * state.box.width)
      mine.lost = first_of(mine.lost, LostGrain{sorted_at_, state.grains.id[i], false});
    for (std::size_t w = 0; w < state.walls.size(); ++w)
      if (state.walls[w].is_near(x, state.grains.radius[i], 0.5 * skin_ + room_for_fall))
        mine.near_walls.push_back({static_cast<std::uint32_t>(i), static_cast<std::int32_t>(w)});
  }
}

/// Lists the grains of `mine` that have a kick from the last step.
void Candidates::list_kicked(const Grains& grains, Slice& mine) {
  mine.kicked.clear();
  for (std::size_t i = mine.begin; i < mine.end; ++i)
    if (grains.kick[i] != FixedVector{} || grains.spin_kick_of(i) != 0)
      mine.kicked.push_back(static_cast<std::uint32_t>(i));
}

FixedVector Candidates::common_motion(std::int64_t step) const {
  return way_of_flight(drift_, fall_, sorted_at_, step);
}

/// m, rounded up.
double Candidates::distance(float squared_displacement) const {
  const double resolution = 2.0 * (static_cast<double>(units_.x) + static_cast<double>(units_.y));
  return std::sqrt(static_cast<double>(squared_displacement)) * (1.0 + 1e-6) + resolution;
}

/// m, rounded up: the largest displacement of the grains of `mine`, whose coarse positions are
/// place(slot).
template <class Place>
double Candidates::farthest(const Slice& mine, std::int64_t step, Place place) const {
  const CoarsePoint common = coarse_motion(step);
  float farthest2 = 0.0F;
  for (std::size_t i = mine.begin; i < mine.end; ++i)
    farthest2 = std::max(farthest2, squared_displacement(place(i), i, common));
  return distance(farthest2);
}

void Candidates::measure_displacements(const PackedPositions& coarse, Slice& mine,
                                       std::int64_t step) const {
  mine.farthest = farthest(mine, step, [&](std::size_t slot) { return coarse.at(slot); });
}

/// To be called before the candidates are listed anew. While they held, each grain was within half
/// the skin of where it was listed; only in the last step may it have gone farther.
void Candidates::note_wandering(const State& state, Slice& mine, std::int64_t step) const {
  const Grains& g = state.grains;
  const double went = farthest(mine, step, [&](std::size_t slot) {
    return CoarsePoint{upper_half(g.position[slot].x), upper_half(g.position[slot].y)};
  });
  mine.wandered += std::max(0.5 * skin_, went);
}

double Candidates::wandered() const { return largest(slices_, &Slice::wandered) + 0.5 * skin_; }

void Candidates::measure_speeds(const State& state, Slice& mine) const {
  const FixedVector *const u = state.grains.u.data(), *const kick = state.grains.kick.data();
  mine.fastest2 =
      largest_square(u + mine.begin, u + mine.end, kick + mine.begin, speedometer(state.box));
}

}  // namespace riesel
