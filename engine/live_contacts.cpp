#include "engine/live_contacts.hpp"

#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace riesel {

namespace {

/// What follows the name in Contact, all of it doubles.
constexpr std::size_t life_begin = offsetof(Contact, begin);
using Life = std::array<double, (sizeof(Contact) - life_begin) / sizeof(double)>;
static_assert(life_begin + sizeof(Life) == sizeof(Contact));

Life life_of(const Contact& contact) {
  Life life;
  std::memcpy(life.data(), reinterpret_cast<const std::byte*>(&contact) + life_begin, sizeof(life));
  return life;
}

/// Which array of LiveContacts holds this member.
#define RIESEL_LIFE(member)                                                                        \
  ((offsetof(Contact, member) - offsetof(Contact, begin)) / sizeof(double))

/// From the friction on name.grain to that on the first body, or back.
void see_from_the_other(Contact& contact) {
  contact.friction_x = -contact.friction_x;
  contact.friction_y = -contact.friction_y;
  contact.rolling_torque = 0.0 - contact.rolling_torque;  // nothing has no sign
}

bool is_rich(const Contact& contact) {
  return contact.spring != 0.0 || contact.torque != 0.0 || contact.rolling_torque != 0.0;
}

/// What a step finds of a contact.
constexpr std::int32_t apart = 1, unusable = 2;

}  // namespace

struct LiveContacts::Columns {
  const std::int64_t *first, *second;
  std::array<Fixed*, 6> partner;  // members of its BodyMotion
  const double *reach, *reduced_mass, *per_mass_first, *per_mass_second;
  std::array<double*, life_members> life;
  std::array<Fixed*, 4> kick;
  std::array<const double*, 2> radius;
  std::array<Fixed*, 2> spin_kick;
};

namespace {

/// Carries the motion of the second grain, as seen from the first, on by one step: gravity is the
/// same for both, and integers add up to the bits that a look at both grains would give. What is
/// new are the last kicks, of all contacts of the two.
template <class Columns>
[[gnu::always_inline]] inline BodyMotion next_motion(const Columns& c, std::size_t i) {
  const Fixed kick_x = c.partner[4][i], kick_y = c.partner[5][i];
  const Fixed ux = wrapped_sum(c.partner[2][i], kick_x);
  const Fixed uy = wrapped_sum(c.partner[3][i], kick_y);
  const Fixed x = wrapped_sum(c.partner[0][i], ux), y = wrapped_sum(c.partner[1][i], uy);
  c.partner[0][i] = x;
  c.partner[1][i] = y;
  c.partner[2][i] = ux;
  c.partner[3][i] = uy;
  return {.x = x, .y = y, .ux = ux, .uy = uy, .kick_x = kick_x, .kick_y = kick_y};
}

template <class Columns>
[[gnu::always_inline]] inline BodyMotion
motion_of_wall(const Columns& c, std::size_t i, const Bodies& bodies, const StepUnits& units) {
  return relative_motion(bodies, c.first[i],
                         {c.partner[0][i], c.partner[1][i], c.partner[2][i], c.partner[3][i],
                          c.partner[4][i], c.partner[5][i]},
                         units);
}

/// Looks at both bodies, where they are now.
template <class Numbers, LiveContacts::Partner partner, class Columns>
[[gnu::always_inline]] inline Encounter encounter_of(const Columns& c, std::size_t i,
                                                     const Bodies& bodies, const StepUnits& units) {
  if constexpr (partner == LiveContacts::Partner::grain)
    return encounter<Numbers>(relative_motion(bodies, c.first[i], c.second[i]), c.reach[i],
                              c.reduced_mass[i], units);
  else
    return encounter<Numbers>(motion_of_wall(c, i, bodies, units), c.reach[i], c.reduced_mass[i],
                              units);
}

/// The same in a contact that has been followed up to the step before.
template <class Numbers, LiveContacts::Partner partner, class Columns>
[[gnu::always_inline]] inline Encounter
next_encounter(const Columns& c, std::size_t i, const Bodies& bodies, const StepUnits& units) {
  if constexpr (partner == LiveContacts::Partner::grain)
    return encounter<Numbers>(next_motion(c, i), c.reach[i], c.reduced_mass[i], units);
  else
    return encounter_of<Numbers, partner>(c, i, bodies, units);
}

template <class Numbers, LiveContacts::Partner partner, class Turn, class Columns>
[[gnu::always_inline]] inline Turn turning_of(const Columns& c, std::size_t i, const Bodies& bodies,
                                              double rolling_friction, const StepUnits& units) {
  if constexpr (std::is_same_v<Turn, Turning>) {
    Spin second;
    if constexpr (partner == LiveContacts::Partner::grain)
      second = spin_of<Numbers>(bodies, c.second[i], units);
    return turning({.radius_first = c.radius[0][i],
                    .radius_second = c.radius[1][i],
                    .per_mass_first = c.per_mass_first[i],
                    .per_mass_second = c.per_mass_second[i]},
                   spin_of<Numbers>(bodies, c.first[i], units), second, bodies.inertia,
                   rolling_friction);
  } else {
    return {};
  }
}

/// The spring is stretched from the very beginning of the contact on.
template <class Slip, class Columns>
[[gnu::always_inline]] inline Stretch stretch_of(const Columns& c, std::size_t i,
                                                 const StepUnits& u) {
  if constexpr (Slip::has_spring)
    return {.spring = c.life[RIESEL_LIFE(spring)][i],
            .time = std::min(u.dt, u.time - c.life[RIESEL_LIFE(begin)][i])};
  else
    return {.spring = 0.0, .time = 0.0};
}

/// What friction took in the step before, as Contact has it: without what went to the spring, with
/// what is left in it when the contact is over. life(member) is as that step left it;
/// `spring_energy` (J) is what is in the spring now.
template <class Life, class Turn, class Slip>
[[gnu::always_inline]] inline double loss_before(const Life& life, const Encounter& e,
                                                 const Turn& turn, const Slip& slip,
                                                 double spring_energy, double dt) {
  double loss =
      loss_by_friction(life(RIESEL_LIFE(friction_x)), life(RIESEL_LIFE(friction_y)), e, dt);
  if constexpr (std::is_same_v<Turn, Turning>)
    loss += loss_by_torques(life(RIESEL_LIFE(torque)), life(RIESEL_LIFE(rolling_torque)), turn, dt);
  if constexpr (Slip::has_spring)
    loss -= spring_energy - slip.stored_energy(life(RIESEL_LIFE(spring)));
  return loss;
}

/// Carries the life of contact i on by one step, if it is one.
/// The loss by friction in the step before is added even if it is over.
template <LiveContacts::Partner partner, class Turn, class Slip, class Columns>
[[gnu::always_inline]] inline void carry_on(const Columns& c, std::size_t i, bool touching,
                                            const Encounter& e, const Turn& turn, const Touch& t,
                                            const Slip& slip, const StepUnits& u) {
  const auto set = [&](std::size_t member, double value) {
    const double before = c.life[member][i];
    c.life[member][i] = touching ? value : before;
  };
  const auto add = [&](std::size_t member, double value) {
    c.life[member][i] += touching ? value : 0.0;
  };
  const auto life = [&](std::size_t member) { return c.life[member][i]; };
  c.life[RIESEL_LIFE(friction_loss)][i] +=
      loss_before(life, e, turn, slip, touching ? t.spring_energy : 0.0, u.dt);
  set(RIESEL_LIFE(friction_x), t.friction_x);
  set(RIESEL_LIFE(friction_y), t.friction_y);
  const double deepest = c.life[RIESEL_LIFE(max_overlap)][i];
  set(RIESEL_LIFE(end), u.time + t.until);
  set(RIESEL_LIFE(overlap), t.overlap);
  set(RIESEL_LIFE(max_overlap), std::max(deepest, t.overlap));
  set(RIESEL_LIFE(elastic_energy), t.elastic_energy);
  add(RIESEL_LIFE(slip_path), std::abs(t.slip) * u.dt);
  add(RIESEL_LIFE(normal_loss), t.normal_power * u.dt);
  if constexpr (partner == LiveContacts::Partner::wall) {
    add(RIESEL_LIFE(impulse_x), t.fx * u.dt);
    add(RIESEL_LIFE(impulse_y), t.fy * u.dt);
    add(RIESEL_LIFE(impulse_y_times_time), t.fy * u.dt * u.time);
  }
  if constexpr (Slip::has_spring) set(RIESEL_LIFE(spring), t.spring);
  if constexpr (std::is_same_v<Turn, Turning>) {
    set(RIESEL_LIFE(torque), t.torque);
    set(RIESEL_LIFE(rolling_torque), t.rolling_torque);
  }
}

/// Writes the kicks of contact i; returns the sum of their sizes, which is not a number if one of
/// them is not.
template <class Numbers, LiveContacts::Partner partner, class Columns>
[[gnu::always_inline]] inline double kick_bodies(const Columns& c, std::size_t i, bool touching,
                                                 const Touch& t, const StepUnits& u) {
  const double fx = touching ? t.fx : 0.0, fy = touching ? t.fy : 0.0;
  const double x = fx * c.per_mass_first[i] * u.kick_x;
  const double y = fy * c.per_mass_first[i] * u.kick_y;
  c.kick[0][i] = Numbers::whole(x);
  c.kick[1][i] = Numbers::whole(y);
  double size = std::abs(x) + std::abs(y);
  if constexpr (partner == LiveContacts::Partner::grain) {
    const double other_x = -fx * c.per_mass_second[i] * u.kick_x;
    const double other_y = -fy * c.per_mass_second[i] * u.kick_y;
    c.kick[2][i] = Numbers::whole(other_x);
    c.kick[3][i] = Numbers::whole(other_y);
    size += std::abs(other_x) + std::abs(other_y);
  }
  return size;
}

/// Likewise for the torques, if the bodies turn.
template <class Numbers, LiveContacts::Partner partner, class Turn, class Columns>
[[gnu::always_inline]] inline double twist_bodies(const Columns& c, std::size_t i, bool touching,
                                                  const Turn& turn, const Touch& t,
                                                  const StepUnits& u) {
  double size = 0.0;
  if constexpr (std::is_same_v<Turn, Turning>) {
    const double torque = touching ? t.torque : 0.0;
    const double rolling = touching ? t.rolling_torque : 0.0;
    const double first =
        (turn.part_first * torque + rolling) * turn.per_inertia_first * u.spin_kick;
    c.spin_kick[0][i] = Numbers::whole(first);
    size = std::abs(first);
    if constexpr (partner == LiveContacts::Partner::grain) {
      const double second =
          (turn.part_second * torque - rolling) * turn.per_inertia_second * u.spin_kick;
      c.spin_kick[1][i] = Numbers::whole(second);
      size += std::abs(second);
    }
  }
  return size;
}

/// One step of `count` contacts, a multiple of the lanes for which there are `flags`. Lanes that do
/// not touch compute nonsense, which is not kept.
template <LiveContacts::Partner partner, class Turn>
struct StepLoop {
  template <class Numbers, class Flag, class Columns, class Normal, class Slip>
  [[gnu::always_inline]] static void
  run(const Columns& columns, std::size_t count, Flag* flags, Flag* block_flags,
      const Bodies& bodies, const StepUnits& units, Normal normal, Slip slip, double mu,
      double rolling_friction, Attraction attraction) {
    constexpr std::size_t lanes = LaneFlags<Flag>::lanes;
    // Of copies only what is used is loaded, and once: what others refer to may change with each
    // store.
    const Columns c = columns;
    const Bodies b = bodies;
    const StepUnits u = units;
    for (std::size_t block = 0; block < count; block += lanes) {
      Flag any = 0;
#pragma omp simd reduction(| : any)
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::size_t i = block + lane;
        const Encounter e = next_encounter<Numbers, partner>(c, i, b, u);
        const bool touching = e.x * e.x + e.y * e.y < e.reach * e.reach;
        const Turn turn = turning_of<Numbers, partner, Turn>(c, i, b, rolling_friction, u);
        const Touch t =
            touch(e, turn, stretch_of<Slip>(c, i, u), normal, slip, mu, attraction, u.dt);
        carry_on<partner>(c, i, touching, e, turn, t, slip, u);
        const double size = kick_bodies<Numbers, partner>(c, i, touching, t, u)
                            + twist_bodies<Numbers, partner>(c, i, touching, turn, t, u);
        // Kicks are integers: what is not a number, or beyond all bounds, must not become one.
        const Flag bad = size < 0x1p62 ? 0 : unusable;
        const Flag over = touching ? 0 : apart;
        flags[i] = over | bad;
        any |= c.reach[i] > 0.0 ? over | bad : 0;  // no lane of the padding
      }
      block_flags[block / lanes] = any;
    }
  }
};

}  // namespace

void add_last_loss(Contact& contact, const Meeting& meeting, const Bodies& bodies,
                   const SlipLaw& slip, const StepUnits& units) {
  const Life so_far = life_of(contact);
  const auto life = [&](std::size_t member) { return so_far[member]; };
  const Encounter e = encounter(meeting, bodies, units);
  contact.friction_loss += std::visit(
      [&](const auto& law) {
        return bodies.rotate()
                   ? loss_before(life, e, turning(meeting, bodies, 0.0, units), law, 0.0, units.dt)
                   : loss_before(life, e, NoTurning{}, law, 0.0, units.dt);
      },
      slip);
}

LiveContacts::Columns LiveContacts::columns() {
  Columns c{.first = body_[0].data(),
            .second = body_[1].data(),
            .partner = {},
            .reach = reach_.data(),
            .reduced_mass = reduced_mass_.data(),
            .per_mass_first = per_mass_[0].data(),
            .per_mass_second = per_mass_[1].data(),
            .life = {},
            .kick = {},
            .radius = {radius_[0].data(), radius_[1].data()},
            .spin_kick = {spin_kick_[0].data(), spin_kick_[1].data()}};
  const auto data = [](auto& a) { return a.data(); };
  std::transform(partner_motion_.begin(), partner_motion_.end(), c.partner.begin(), data);
  std::transform(life_.begin(), life_.end(), c.life.begin(), data);
  std::transform(kick_.begin(), kick_.end(), c.kick.begin(), data);
  return c;
}

Contact LiveContacts::contact(std::size_t i) const {
  Contact contact{.name = meetings_[i].name};
  // Word by word where they stay: an array of them would be copied in wider words, and these wait
  // until their parts are written.
  auto* const life = reinterpret_cast<std::byte*>(&contact) + life_begin;
  for (std::size_t m = 0; m < members(); ++m)
    std::memcpy(life + m * sizeof(double), &life_[m][i], sizeof(double));
  if (meetings_[i].turned) see_from_the_other(contact);
  return contact;
}

template <class Visit>
void LiveContacts::for_each_array(Visit visit) {
  for (auto& a : body_) visit(a);
  for (auto& a : partner_motion_) visit(a);
  visit(reach_);
  visit(reduced_mass_);
  for (auto& a : per_mass_) visit(a);
  for (std::size_t m = 0; m < poor_life_members; ++m) visit(life_[m]);
  for (auto& a : kick_) visit(a);
  if (!rich_) return;
  for (std::size_t m = poor_life_members; m < life_members; ++m) visit(life_[m]);
  for (auto& a : radius_) visit(a);
  for (auto& a : spin_kick_) visit(a);
}

void LiveContacts::become_rich() {
  if (rich_) return;
  rich_ = true;
  for_each_array([&](auto& a) { a.resize(reach_.size()); });
  for (std::size_t i = 0; i < size(); ++i) {
    radius_[0][i] = meetings_[i].radius_first;
    radius_[1][i] = meetings_[i].radius_second;
  }
}

/// The state is to be kept, for a look at it: without the kicks and the numbers of a contact that
/// are none.
void LiveContacts::make_harmless(std::size_t i) {
  for (auto& kicks : kick_) kicks[i] = 0;
  if (rich_)
    for (auto& kicks : spin_kick_) kicks[i] = 0;
  for (std::size_t m = 0; m < members(); ++m)
    if (!std::isfinite(life_[m][i])) life_[m][i] = 0.0;
}

/// The points of smooth walls go along with their grains, those of moving walls with the walls.
void LiveContacts::follow_walls(const Bodies& bodies, const StepUnits& units) {
  for (std::size_t i = 0; i < size(); ++i) {
    const BodyMotion point = wall_point(meetings_[i], bodies, body_[0][i], units);
    const auto members = std::bit_cast<std::array<Fixed, 6>>(point);
    for (std::size_t member = 0; member < members.size(); ++member)
      partner_motion_[member][i] = members[member];
  }
}

/// Contacts get the last kicks of their grains: one by one, as vectors are slower at gathering.
/// Those that have been added since the last step know nothing of their grains' motion yet: they
/// get that of the step before.
void LiveContacts::follow_bodies(const Columns& c, const Bodies& bodies) const {
  for (std::size_t i = 0; i < size(); ++i) {
    const std::int64_t first = c.first[i], second = c.second[i];
    c.partner[4][i] = wrapped_difference(bodies.kick_x[second], bodies.kick_x[first]);
    c.partner[5][i] = wrapped_difference(bodies.kick_y[second], bodies.kick_y[first]);
  }
  for (std::size_t i = followed_; i < size(); ++i) {
    const BodyMotion now = relative_motion(bodies, c.first[i], c.second[i]);
    c.partner[0][i] = wrapped_difference(now.x, now.ux);
    c.partner[1][i] = wrapped_difference(now.y, now.uy);
    c.partner[2][i] = wrapped_difference(now.ux, now.kick_x);
    c.partner[3][i] = wrapped_difference(now.uy, now.kick_y);
  }
}

/// Room for whole blocks; what is beyond size() is zero, but for the bodies.
void LiveContacts::pad() {
  const std::size_t room = LaneFlags<std::int32_t>::padded(size());
  if (reach_.size() >= room) return;
  for (auto& a : body_) a.resize(2 * room, padding_body_);
  for_each_array([&](auto& a) { a.resize(2 * room); });
  found_of_many_.resize(2 * room);
}

void LiveContacts::pad_with(std::int64_t place) {
  padding_body_ = place;
  for (auto& a : body_) std::fill(a.begin() + static_cast<std::ptrdiff_t>(size()), a.end(), place);
}

void LiveContacts::clear() {
  meetings_.clear();
  beginning_ = followed_ = 0;
  any_level_ = false;
  for_each_array([](auto& a) { std::fill(a.begin(), a.end(), 0); });
  pad_with(padding_body_);
}

void LiveContacts::add(const Meeting& meeting, const Contact& contact) {
  if (is_rich(contact)) become_rich();
  const std::size_t i = size();
  meetings_.push_back(meeting);
  any_level_ = any_level_ || meeting.level;
  pad();
  body_[0][i] = meeting.first;
  body_[1][i] = meeting.second;
  partner_motion_[0][i] = meeting.line;
  partner_motion_[1][i] = meeting.y;
  reach_[i] = meeting.reach();
  reduced_mass_[i] = meeting.reduced_mass();
  const BodyPair bodies = meeting.bodies();
  per_mass_[0][i] = bodies.per_mass_first;
  per_mass_[1][i] = bodies.per_mass_second;
  Contact seen = contact;
  if (meeting.turned) see_from_the_other(seen);
  const Life life = life_of(seen);
  for (std::size_t m = 0; m < members(); ++m) life_[m][i] = life[m];
  if (!rich_) return;
  radius_[0][i] = bodies.radius_first;
  radius_[1][i] = bodies.radius_second;
}

void LiveContacts::remove(std::size_t i) {
  const std::size_t last = size() - 1;
  meetings_[i] = meetings_[last];
  meetings_.pop_back();
  --followed_;
  for_each_array([&](auto& a) {
    a[i] = a[last];
    a[last] = 0;
  });
  for (auto& a : body_) a[last] = padding_body_;
}

template <LiveContacts::Partner partner, class Turn, class Normal, class Slip>
void LiveContacts::step(const Bodies& bodies, const StepUnits& units, const ContactModel& model,
                        const Normal& normal, const Slip& slip) {
  const Columns c = columns();
  if constexpr (partner == Partner::grain) follow_bodies(c, bodies);
  for (std::size_t i = size() - beginning_; i < size(); ++i) {
    const Touch t = touch(encounter_of<ByConversion, partner>(c, i, bodies, units),
                          turning_of<ByConversion, partner, Turn>(c, i, bodies, 0.0, units),
                          Stretch{.spring = 0.0, .time = 0.0}, normal, slip, model.friction,
                          model.attraction, units.dt);
    c.life[RIESEL_LIFE(begin)][i] = units.time - t.since;
    c.life[RIESEL_LIFE(entry_rate)][i] = t.rate;
    c.life[RIESEL_LIFE(entry_slip)][i] = t.centre_slip;
  }
  beginning_ = 0;
  followed_ = size();
  with_found([&](auto& found) {
    run_vector_loop<StepLoop<partner, Turn>>(
        c, found.padded(size()), found.of_lanes.data(), found.of_blocks.data(), bodies, units,
        normal, slip, model.friction, model.rolling_friction, model.attraction);
  });
}

template <LiveContacts::Partner partner>
void LiveContacts::step(const Bodies& bodies, const StepUnits& units, const ContactModel& model) {
  std::visit(
      [&](const auto& normal, const auto& slip) {
        if (bodies.rotate() || slip.has_spring) become_rich();
        if (bodies.rotate())
          step<partner, Turning>(bodies, units, model, normal, slip);
        else
          step<partner, NoTurning>(bodies, units, model, normal, slip);
      },
      model.normal, model.slip);
}

void LiveContacts::step(const Bodies& bodies, const StepUnits& units, const ContactModel& model) {
  ended_.clear();
  trouble_.reset();
  if (size() == 0) return;
  if (any_level_ || (partner_ == Partner::wall && units.walls_move)) follow_walls(bodies, units);
  if (partner_ == Partner::grain)
    step<Partner::grain>(bodies, units, model);
  else
    step<Partner::wall>(bodies, units, model);
  with_found([&](const auto& found) {
    found.for_each_set(size(), [&](std::size_t i, std::int64_t flag) {
      if ((flag & apart) != 0) ended_.push_back(i);
      if ((flag & unusable) == 0) return;
      trouble_ = first_of(trouble_, meetings_[i].name);
      make_harmless(i);
    });
  });
  std::reverse(ended_.begin(), ended_.end());
}

}  // namespace riesel
