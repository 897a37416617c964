#include "engine/parts.hpp"

#include "engine/flights.hpp"
#include "engine/team.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace riesel {

namespace {

/// m beyond the farthest grain that own ones can meet: what the common motions of two parts may
/// differ by in a stretch, and what a stretch may take to bring news through, in diameters.
constexpr double slack_per_diameter = 0.35, buffer_per_diameter = 3.0;

/// Stretches become longer as long as they are not in vain.
constexpr double longer_at_first = 1.5, longer = 1.002, shorter = 0.9;

double largest_reach(const State& state) {
  double largest = *std::max_element(state.grains.radius.begin(), state.grains.radius.end());
  const double grains = largest;
  for (const WallLattice& wall : state.walls) largest = std::max(largest, wall.radius);
  return grains + largest;
}

double margin(const State& state, bool by_flights) {
  const double skin =
      (by_flights ? Flights::purpose : Candidates::plain_stepping).skin_per_diameter;
  const double diameter = mean_diameter(state.grains);
  return largest_reach(state) + (skin + slack_per_diameter + buffer_per_diameter) * diameter;
}

/// Calls visit(array) for each array that stepping changes.
template <class AnyGrains, class Visit>
void for_each_moving_array(AnyGrains& g, Visit visit) {
  for (auto array : {&AnyGrains::x, &AnyGrains::y, &AnyGrains::ux, &AnyGrains::uy,
                     &AnyGrains::kick_x, &AnyGrains::kick_y})
    visit(array);
  if (!g.rotate()) return;
  for (auto array : {&AnyGrains::spin, &AnyGrains::spin_kick}) visit(array);
}

void sort_by_id(Grains& grains) {
  const std::vector<std::size_t> slots = slots_by_id(grains);
  const Grains old = grains;
  const auto reorder = [&](auto& to, const auto& from) {
    for (std::size_t id = 0; id < slots.size(); ++id) to[id] = from[slots[id]];
  };
  for_each_moving_array(grains, [&](auto array) { reorder(grains.*array, old.*array); });
  reorder(grains.radius, old.radius);
  reorder(grains.mass, old.mass);
  reorder(grains.id, old.id);
}

}  // namespace

/// The grains of one part, and of its margin.
class Parts::Part {
public:
  /// A stretch of the ring, in quanta of y.
  struct Zone {
    std::uint64_t begin, length, margin;

    /// How far `y` is from it.
    std::uint64_t distance(Fixed y) const {
      const std::uint64_t from_begin = static_cast<std::uint64_t>(y) - begin;
      if (from_begin < length) return 0;
      return std::min(from_begin - length, std::uint64_t{0} - from_begin);
    }
  };

  explicit Part(const State& whole) {
    state_.box = whole.box;
    state_.walls = whole.walls;
    state_.gravity = whole.gravity;
    state_.time_step = whole.time_step;
    state_.grains.inertia = whole.grains.inertia;
  }

  void cut(const State& whole, const Zone& zone) {
    stepper_.reset();
    state_.step = whole.step;
    id_.clear();
    distance_.clear();
    own_.clear();
    const Grains& all = whole.grains;
    for (std::size_t id = 0; id < all.size(); ++id) {
      const std::uint64_t distance = zone.distance(all.y[id]);
      if (distance > zone.margin) continue;
      id_.push_back(static_cast<std::int32_t>(id));
      distance_.push_back(distance);
      own_.push_back(distance == 0 ? 1 : 0);
    }
    Grains& g = state_.grains;
    g.resize(id_.size());
    const auto gather = [&](auto& to, const auto& from) {
      for (std::size_t i = 0; i < id_.size(); ++i) to[i] = from[static_cast<std::size_t>(id_[i])];
    };
    for_each_moving_array(g, [&](auto array) { gather(g.*array, all.*array); });
    gather(g.radius, all.radius);
    gather(g.mass, all.mass);
    for (std::size_t i = 0; i < id_.size(); ++i) g.id[i] = static_cast<std::int32_t>(i);
    state_.contacts.clear();
    for (const Contact& contact : whole.contacts)
      if (const auto name = name_here(contact.name)) {
        state_.contacts.push_back(contact);
        state_.contacts.back().name = *name;
      }
  }

  void step(const ContactModel& model, bool by_flights, std::int64_t last, bool profiled) {
    constexpr Askew together{.fewest = SIZE_MAX};
    stepper_.emplace(state_, model,
                     Stepper::Manner{.by_flights = by_flights, .threads = 1, .slices_per_thread = 1},
                     together);
    stepper_->count_only(own_);
    if (profiled) stepper_->start_profile();
    began_ = state_.step;
    stepper_->advance(last);
  }

  /// Whether all steps were done with the candidates of the beginning.
  bool held() const {
    const Candidates& candidates = stepper_->candidates();
    return !candidates.in_trouble() && candidates.sorted_at() == began_;
  }

  double skin() const { return stepper_->candidates().skin(); }
  Fixed drift() const { return stepper_->candidates().drift().y; }

  void write(Grains& next) const {
    const Grains& g = state_.grains;
    for_each_moving_array(g, [&](auto array) {
      const auto& from = g.*array;
      auto& to = next.*array;
      for (std::size_t slot = 0; slot < g.size(); ++slot)
        if (owns(slot)) to[id_of(slot)] = from[slot];
    });
  }

  /// Whether the copies that were no farther than this (quanta of y) are what the originals are.
  bool agrees(const Grains& next, std::uint64_t farthest, std::uint64_t margin) const {
    if (farthest > margin) return false;
    const Grains& g = state_.grains;
    bool same = true;
    for_each_moving_array(g, [&](auto array) {
      const auto& here = g.*array;
      const auto& there = next.*array;
      for (std::size_t slot = 0; slot < g.size(); ++slot)
        if (!owns(slot) && distance_[static_cast<std::size_t>(g.id[slot])] <= farthest)
          same = same && here[slot] == there[id_of(slot)];
    });
    return same;
  }

  void hand_over(Tally& tally, Profile& profile, std::vector<Contact>& contacts) {
    Tally mine;
    stepper_->hand_over(mine, profile);
    for (ContactTally* kind : {&mine.grains, &mine.walls})
      if (kind->deepest) rename(kind->deepest->name);
    for (Contact& contact : mine.ended_at_walls) rename(contact.name);
    tally.merge(mine);
    for (Contact& contact : stepper_->candidates().contacts())
      if (own_[static_cast<std::size_t>(contact.name.grain)] != 0) {
        rename(contact.name);
        contacts.push_back(contact);
      }
  }

private:
  bool owns(std::size_t slot) const {
    return own_[static_cast<std::size_t>(state_.grains.id[slot])] != 0;
  }
  std::size_t id_of(std::size_t slot) const {
    return static_cast<std::size_t>(id_[static_cast<std::size_t>(state_.grains.id[slot])]);
  }
  std::int32_t id_here(std::int32_t id) const {
    const auto found = std::lower_bound(id_.begin(), id_.end(), id);
    return found != id_.end() && *found == id ? static_cast<std::int32_t>(found - id_.begin()) : -1;
  }
  std::optional<ContactName> name_here(ContactName name) const {
    name.grain = id_here(name.grain);
    if (name.wall == no_wall) name.partner = id_here(name.partner);
    if (name.grain < 0 || (name.wall == no_wall && name.partner < 0)) return std::nullopt;
    return name;
  }
  void rename(ContactName& name) const {
    name.grain = id_[static_cast<std::size_t>(name.grain)];
    if (name.wall == no_wall) name.partner = id_[static_cast<std::size_t>(name.partner)];
  }

  State state_;                          // with ids of its own, in the same order
  std::vector<std::int32_t> id_;         // in the whole, by id here
  std::vector<std::uint64_t> distance_;  // quanta of y, from the part, by id here
  std::vector<std::uint8_t> own_;        // by id here
  std::optional<Stepper> stepper_;
  std::int64_t began_ = 0;
};

Parts::Parts(State& state, const ContactModel& model, bool by_flights, int threads)
    : state_(state),
      model_(model),
      by_flights_(by_flights),
      reach_(largest_reach(state)),
      margin_(quanta(margin(state, by_flights))),
      team_(threads),
      agreed_(static_cast<std::size_t>(threads)),
      borders_(static_cast<std::size_t>(threads) + 1) {
  sort_by_id(state.grains);
  next_ = state.grains;
  for (int part = 0; part < threads; ++part) parts_.push_back(std::make_unique<Part>(state));
}

Parts::~Parts() = default;

bool Parts::pay(const State& state, bool by_flights, int threads) {
  constexpr double least_margins = 4.0;
  return state.box.length > least_margins * threads * margin(state, by_flights);
}

std::uint64_t Parts::quanta(double metres) const {
  return static_cast<std::uint64_t>(metres / state_.box.quantum_y());
}

void Parts::advance(std::int64_t last, Profile& profile) {
  if (whole_) whole_->fail_if_in_trouble();
  as_a_team(static_cast<int>(parts_.size()), [&](std::size_t member) {
    while (true) {
      if (member == 0) plan(last);
      team_.arrive_and_wait(member);
      if (over_) return;
      Part& mine = *parts_[member];
      mine.cut(state_, {borders_[member], borders_[member + 1] - borders_[member], margin_});
      mine.step(model_, by_flights_, until_, member == 0 && profile.on());
      mine.write(next_);
      team_.arrive_and_wait(member);
      agreed_[member] = mine.held() && mine.agrees(next_, farthest_that_matters(), margin_);
      team_.arrive_and_wait(member);
      if (member == 0) conclude(profile);
    }
  });
  if (whole_) whole_->fail_if_in_trouble();
}

/// How long the next stretch is to be, and where its parts begin: with as many grains each.
void Parts::plan(std::int64_t last) {
  over_ = whole_ || state_.step >= last;
  if (over_) return;
  until_ = std::min(last, state_.step + static_cast<std::int64_t>(steps_));
  constexpr int bits = 12;
  std::array<std::uint32_t, std::size_t{1} << bits> count{};
  for (const Fixed y : state_.grains.y) ++count[static_cast<std::uint64_t>(y) >> (64 - bits)];
  std::size_t bin = 0, before = 0;
  for (std::size_t part = 1; part < parts_.size(); ++part) {
    const std::size_t wanted = state_.grains.size() * part / parts_.size();
    while (bin < count.size() && before < wanted) before += count[bin++];
    borders_[part] = static_cast<std::uint64_t>(bin) << (64 - bits);
  }
}

/// Quanta of y: nobody farther from a part has met a grain of it in this stretch.
std::uint64_t Parts::farthest_that_matters() const {
  double skin = 0.0;
  Fixed slowest = parts_.front()->drift(), fastest = slowest;
  for (const auto& part : parts_) {
    skin = std::max(skin, part->skin());
    slowest = std::min(slowest, part->drift());
    fastest = std::max(fastest, part->drift());
  }
  const double apart = state_.box.metres_y(wrapped_difference(fastest, slowest))
                       * static_cast<double>(until_ - state_.step);
  return quanta(reach_ + skin + apart);
}

void Parts::conclude(Profile& profile) {
  ++stretches_;
  if (std::all_of(agreed_.begin(), agreed_.end(), [](bool agreed) { return agreed; })) {
    keep(profile);
    steps_ *= in_vain_ == 0 ? longer_at_first : longer;
  } else {
    ++in_vain_;
    do_together(profile);
    steps_ = std::max(steps_ * shorter, 2.0);
  }
}

void Parts::keep(Profile& profile) {
  for_each_moving_array(state_.grains,
                        [&](auto array) { std::swap(state_.grains.*array, next_.*array); });
  state_.contacts.clear();
  for (const auto& part : parts_) part->hand_over(state_.tally, profile, state_.contacts);
  std::sort(state_.contacts.begin(), state_.contacts.end(),
            [](const Contact& a, const Contact& b) { return a.name < b.name; });
  state_.step = until_;
}

void Parts::do_together(Profile& profile) {
  whole_.emplace(state_, model_, Stepper::Manner{by_flights_, 1, 1}, Askew{.fewest = SIZE_MAX});
  whole_->advance(until_);
  whole_->hand_over(state_.tally, profile);
  state_.contacts = whole_->candidates().contacts();
  if (whole_->candidates().in_trouble()) return;
  whole_.reset();
  sort_by_id(state_.grains);
}

}  // namespace riesel
