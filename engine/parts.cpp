#include "engine/parts.hpp"

#include "engine/flights.hpp"
#include "engine/team.hpp"

#include <algorithm>
#include <array>

#include <iterator>
#include <span>
#include <numeric>
#include <cmath>
#include <omp.h>
#include <cstdio>

#include <utility>

namespace riesel {

namespace {

/// Stretches become longer as long as they are not in vain.
constexpr double longer = 1.005, shorter = 0.95;
constexpr double least_buffer = 1.0, wider = 1.4, narrower = 0.998;

constexpr Askew never_askew{.fewest = SIZE_MAX};

double largest_reach(const State& state) {
  double largest = *std::max_element(state.grains.radius.begin(), state.grains.radius.end());
  const double grains = largest;
  for (const WallLattice& wall : state.walls) largest = std::max(largest, wall.radius);
  return grains + largest;
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

/// And for the others.
template <class AnyGrains, class Visit>
void for_each_array(AnyGrains& g, Visit visit) {
  for_each_moving_array(g, visit);
  visit(&AnyGrains::radius);
  visit(&AnyGrains::mass);
  visit(&AnyGrains::id);
}

}  // namespace

/// The grains of one part, and copies of those of its margin.
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

  Part(const State& whole, const ContactModel& model, bool by_flights)
      : state_{.box = whole.box,
               .walls = whole.walls,
               .gravity = whole.gravity,
               .time_step = whole.time_step,
               .step = whole.step,
               .grains = whole.grains},
        stepper_(state_, model, {.by_flights = by_flights, .threads = 1, .slices_per_thread = 1},
                 never_askew) {}

  void cut(const State& whole, std::span<const std::unique_ptr<Part>> parts, const Zone& zone) {
    state_.step = whole.step;
    choose(whole.grains, zone);
    Grains& g = state_.grains;
    g.resize(places_.size());
    for_each_array(g, [&](auto array) {
      const auto& from = whole.grains.*array;
      auto& to = g.*array;
      for (std::size_t i = 0; i < places_.size(); ++i) to[i] = from[places_[i]];
    });
    is_own_.assign(whole.grains.size(), 0);
    is_here_.assign(whole.grains.size(), 0);
    rank_.resize(whole.grains.size());
    slots_.resize(places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) {
      is_here_[id(i)] = 1;
      rank_[id(i)] = static_cast<std::uint32_t>(i);
    }
    for (std::size_t i = 0; i < own_; ++i) is_own_[id(i)] = 1;
    state_.contacts.clear();
    for (const auto& part : parts)
      std::copy_if(part->contacts_.begin(), part->contacts_.end(),
                   std::back_inserter(state_.contacts),
                   [&](const Contact& contact) { return all_here(contact.name); });
  }

  void step(Fixed drift, std::int64_t last, bool profiled) {
    if (profiled) stepper_.start_profile();
    began_ = state_.step;
    stepper_.start_from(state_, drift);
    stepper_.count_only(is_own_);
    stepper_.advance(last);
    for (std::size_t slot = 0; slot < slots_.size(); ++slot)
      slots_[rank_[id(slot)]] = static_cast<std::uint32_t>(slot);
  }

  bool in_trouble() const { return stepper_.candidates().in_trouble(); }
  bool has_sorted() const { return stepper_.candidates().sorted_at() > began_; }
  double wandered() const { return stepper_.candidates().wandered(); }

  void write(Grains& next) const {
    for_each_moving_array(state_.grains, [&](auto array) {
      const auto& from = state_.grains.*array;
      auto& to = next.*array;
      for (std::size_t i = 0; i < own_; ++i) to[places_[i]] = from[slots_[i]];
    });
  }

  /// Whether the copies that were no farther than this (quanta of y) are what the originals are.
  bool agrees(const Grains& next, std::uint64_t farthest, std::uint64_t margin) const {
    if (farthest > margin) return false;
    bool same = true;
    for_each_moving_array(state_.grains, [&](auto array) {
      const auto& here = state_.grains.*array;
      const auto& there = next.*array;
      for (std::size_t i = own_; i < places_.size(); ++i)
        if (distances_[i - own_] <= farthest) same = same && here[slots_[i]] == there[places_[i]];
    });
    return same;
  }

  void keep() {
    stepper_.hand_over(tally_, profile_);
    contacts_.clear();
    stepper_.candidates().for_each_contact([&](const Contact& contact) {
      if (is_own_[static_cast<std::size_t>(contact.name.grain)] != 0) contacts_.push_back(contact);
    });
  }

  void take_over(std::vector<Contact>& contacts) { contacts_.swap(contacts); }

  void hand_over(State& whole, Profile& profile) {
    whole.tally.merge(tally_);
    tally_ = {};
    profile.merge(profile_);
    profile_ = Profile(profile.on());
    whole.contacts.insert(whole.contacts.end(), contacts_.begin(), contacts_.end());
    contacts_.clear();
  }

  double seconds = 0.0;

private:
  void choose(const Grains& all, const Zone& zone) {
    places_.clear();
    copies_.clear();
    distances_.clear();
    for (std::size_t place = 0; place < all.size(); ++place) {
      const std::uint64_t distance = zone.distance(all.y[place]);
      if (distance > zone.margin) continue;
      if (distance > 0) distances_.push_back(distance);
      (distance > 0 ? copies_ : places_).push_back(static_cast<std::uint32_t>(place));
    }
    own_ = places_.size();
    places_.insert(places_.end(), copies_.begin(), copies_.end());
  }
  std::size_t id(std::size_t slot) const { return static_cast<std::size_t>(state_.grains.id[slot]); }
  bool all_here(const ContactName& name) const {
    const auto here = [&](std::int32_t id) { return is_here_[static_cast<std::size_t>(id)] != 0; };
    return here(name.grain) && (name.wall != no_wall || here(name.partner));
  }

  State state_;
  Stepper stepper_;
  std::size_t own_ = 0;                       // grains; the others are copies
  std::vector<std::uint32_t> places_;         // in the whole; of the own ones first
  std::vector<std::uint32_t> slots_;          // here, in the same order, after the stretch
  std::vector<std::uint32_t> rank_;           // in these two, by id
  std::vector<std::uint32_t> copies_;         // while grains are chosen
  std::vector<std::uint64_t> distances_;      // quanta of y, of the copies from the part
  std::vector<std::uint8_t> is_own_, is_here_;  // by id
  std::int64_t began_ = 0;
  std::vector<Contact> contacts_;
  Tally tally_;
  Profile profile_;
};

Parts::Parts(State& state, const ContactModel& model, bool by_flights, int threads)
    : state_(state),
      model_(model),
      by_flights_(by_flights),
      reach_(largest_reach(state)),
      diameter_(mean_diameter(state.grains)),
      skin_((by_flights ? Flights::purpose : Candidates::plain_stepping).skin_per_diameter),
      most_buffer_(std::max(least_buffer, 0.15*state.box.length/threads/diameter_)),
      team_(threads),
      agreed_(static_cast<std::size_t>(threads)),
      borders_(static_cast<std::size_t>(threads) + 1) {
  sort();
  weight_.assign(threads, 1.0);
  for (int part = 0; part < threads; ++part) parts_.push_back(std::make_unique<Part>(state, model, by_flights));
}

Parts::~Parts() { fprintf(stderr, "stretches %ld in vain %ld resorted %ld steps %g buffer %g\n", stretches_, in_vain_, resorted_, steps_, buffer_); }

bool Parts::pay(const State& state, bool by_flights, int threads) {
  constexpr double least_margins = 4.0;
  return state.box.length > least_margins * threads * mean_diameter(state.grains) * 5;
}

std::uint64_t Parts::quanta(double metres) const {
  return static_cast<std::uint64_t>(metres / state_.box.quantum_y());
}

void Parts::advance(std::int64_t last, Profile& profile) {
  if (whole_) whole_->fail_if_in_trouble();
  parts_.front()->take_over(state_.contacts);
  state_.contacts.clear();
  as_a_team(static_cast<int>(parts_.size()), [&](std::size_t member) {
    while (true) {
      if (member == 0) plan(last);
      team_.arrive_and_wait(member);
      if (over_) return;
      Part& mine = *parts_[member];
      const double begin = omp_get_wtime();
      mine.cut(state_, parts_, {borders_[member], borders_[member + 1] - borders_[member], margin_});
      mine.step(drift_, until_, member == 0 && profile.on());
      mine.write(next_);
      mine.seconds = omp_get_wtime() - begin;
      team_.arrive_and_wait(member);
      agreed_[member] = !mine.in_trouble() && mine.agrees(next_, farthest_that_matters(), margin_);
      team_.arrive_and_wait(member);
      if (all_agree()) mine.keep();
      if (member == 0) conclude(profile);
    }
  });
  for (const auto& part : parts_) part->hand_over(state_, profile);
  std::sort(state_.contacts.begin(), state_.contacts.end(),
            [](const Contact& a, const Contact& b) { return a.name < b.name; });
  if (whole_) whole_->fail_if_in_trouble();
}

bool Parts::all_agree() const {
  return std::all_of(agreed_.begin(), agreed_.end(), [](bool agreed) { return agreed; });
}

/// So that the grains of a part are close together, and no other thread writes close to them.
void Parts::sort() {
  TeamBarrier alone(1);
  Cells().sort(state_, reach_, alone, 0);
  next_ = state_.grains;
}

/// How long the next stretch is to be, and where its parts begin: with as many grains each.
void Parts::plan(std::int64_t last) {
  over_ = whole_ || state_.step >= last;
  if (over_) return;
  constexpr std::int64_t stretches_of_an_order = 64;
  drift_ = middle_velocity(state_.grains);
  margin_ = quanta(reach_ + (skin_ + buffer_) * diameter_);
  if (stretches_ % stretches_of_an_order == 0) sort();
  until_ = std::min(last, state_.step + static_cast<std::int64_t>(steps_));
  constexpr int bits = 12;
  std::array<std::uint32_t, std::size_t{1} << bits> count{};
  for (const Fixed y : state_.grains.y) ++count[static_cast<std::uint64_t>(y) >> (64 - bits)];
  std::size_t bin = 0, before = 0;
  double sum=0, total = std::accumulate(weight_.begin(), weight_.end(), 0.0);
  for (std::size_t part = 1; part < parts_.size(); ++part) {
    sum += weight_[part-1];
    const double wanted = double(state_.grains.size()) * sum / total;
    while (bin < count.size() && before < wanted) before += count[bin++];
    borders_[part] = static_cast<std::uint64_t>(bin) << (64 - bits);
  }
}

/// Quanta of y: nobody farther from a part has met a grain of it in this stretch.
std::uint64_t Parts::farthest_that_matters() const {
  double wandered = 0.0;
  for (const auto& part : parts_) wandered = std::max(wandered, part->wandered());
  return quanta(reach_ + 2.0 * wandered);
}

void Parts::conclude(Profile& profile) {
  ++stretches_;
  if (all_agree()) {
    keep();
    const bool sorted = std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->has_sorted(); });
    resorted_ += sorted;
    steps_ *= sorted ? shorter : longer;
    buffer_ = std::max(least_buffer, buffer_ * narrower);
  } else {
    ++in_vain_;
    do_together(profile);
    if (buffer_ < most_buffer_) buffer_ *= wider;
    else steps_ *= 0.9;
    steps_ = std::max(steps_, 2.0);
  }
}

void Parts::keep() {
  for_each_moving_array(state_.grains,
                        [&](auto array) { std::swap(state_.grains.*array, next_.*array); });
  state_.step = until_;
  double all = 0.0;
  for (const auto& part : parts_) all += part->seconds;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const double fair = all / parts_.size() / parts_[i]->seconds;
    weight_[i] *= std::clamp(std::sqrt(std::sqrt(fair)), 0.98, 1.02);
  }
}

void Parts::do_together(Profile& profile) {
  std::vector<Contact> contacts;
  for (const auto& part : parts_) part->hand_over(state_, profile);
  whole_.emplace(state_, model_, Stepper::Manner{by_flights_, 1, 1}, never_askew);
  whole_->advance(until_);
  whole_->hand_over(state_.tally, profile);
  state_.contacts = whole_->candidates().contacts();
  if (whole_->candidates().in_trouble()) return;
  parts_.front()->take_over(state_.contacts);
  state_.contacts.clear();
  whole_.reset();
  next_ = state_.grains;
}

}  // namespace riesel
