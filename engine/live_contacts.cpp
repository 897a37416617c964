#include "engine/live_contacts.hpp"

#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace riesel {

namespace {

/// Contact as an array of doubles; the name fills the first of them.
using Words = std::array<double, sizeof(Contact) / sizeof(double)>;
constexpr std::size_t life_begin = offsetof(Contact, begin) / sizeof(double);

/// Which array of LiveContacts holds this member.
#define RIESEL_LIFE(member)                                                                        \
  ((offsetof(Contact, member) - offsetof(Contact, begin)) / sizeof(double))

/// From the friction on name.grain to that on the first body, or back.
Contact seen_from(const Meeting& meeting, Contact contact) {
  if (meeting.turned) {
    contact.friction_x = -contact.friction_x;
    contact.friction_y = -contact.friction_y;
  }
  return contact;
}

/// What a step finds of a contact.
constexpr std::int64_t apart = 1, unusable = 2;

}  // namespace

struct LiveContacts::Columns {
  const std::int64_t *first, *second;
  const Fixed *line, *y;
  const double *reach, *reduced_mass, *per_mass_first, *per_mass_second;
  std::array<double*, life_members> life;
  std::array<Fixed*, 4> kick;
  std::int64_t *flags, *block_flags;
};

namespace {

template <LiveContacts::Partner partner, class Columns>
[[gnu::always_inline]] inline Encounter encounter_of(const Columns& c, std::size_t i,
                                                     const Bodies& bodies, const StepUnits& units) {
  if constexpr (partner == LiveContacts::Partner::grain)
    return encounter(relative_motion(bodies, c.first[i], c.second[i]), c.reach[i],
                     c.reduced_mass[i], units);
  else
    return encounter(relative_motion(bodies, c.first[i], c.line[i], c.y[i], units), c.reach[i],
                     c.reduced_mass[i], units);
}

/// Carries the life of contact i on by one step, if it is one.
/// The loss by friction in the step before is added even if it is over.
template <LiveContacts::Partner partner, class Columns>
[[gnu::always_inline]] inline void carry_on(const Columns& c, std::size_t i, bool touching,
                                            const Encounter& e, const Touch& t,
                                            const StepUnits& u) {
  const auto set = [&](std::size_t member, double value) {
    const double before = c.life[member][i];
    c.life[member][i] = touching ? value : before;
  };
  const auto add = [&](std::size_t member, double value) {
    c.life[member][i] += touching ? value : 0.0;
  };
  c.life[RIESEL_LIFE(friction_loss)][i] += loss_by_friction(
      c.life[RIESEL_LIFE(friction_x)][i], c.life[RIESEL_LIFE(friction_y)][i], e, u.dt);
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
    add(RIESEL_LIFE(impulse_y_times_step), t.fy * u.dt * u.step);
  }
}

/// Writes the kicks of contact i; returns the sum of their sizes, which is not a number if one of
/// them is not.
template <LiveContacts::Partner partner, class Columns>
[[gnu::always_inline]] inline double kick_bodies(const Columns& c, std::size_t i, bool touching,
                                                 const Touch& t, const StepUnits& u) {
  const double fx = touching ? t.fx : 0.0, fy = touching ? t.fy : 0.0;
  const double x = fx * c.per_mass_first[i] * u.kick_x;
  const double y = fy * c.per_mass_first[i] * u.kick_y;
  c.kick[0][i] = nearest_fixed(x);
  c.kick[1][i] = nearest_fixed(y);
  double size = std::abs(x) + std::abs(y);
  if constexpr (partner == LiveContacts::Partner::grain) {
    const double other_x = -fx * c.per_mass_second[i] * u.kick_x;
    const double other_y = -fy * c.per_mass_second[i] * u.kick_y;
    c.kick[2][i] = nearest_fixed(other_x);
    c.kick[3][i] = nearest_fixed(other_y);
    size += std::abs(other_x) + std::abs(other_y);
  }
  return size;
}

/// One step of `count` contacts, a multiple of `lanes`. Lanes that do not touch compute nonsense,
/// which is not kept.
template <LiveContacts::Partner partner, std::size_t lanes, class Columns, class Normal, class Slip>
RIESEL_VECTOR_KERNEL void step_lanes(Columns c, std::size_t count, Bodies b, StepUnits u,
                                     Normal normal, Slip slip, double mu, Attraction attraction) {
  for (std::size_t block = 0; block < count; block += lanes) {
    std::int64_t any = 0;
#pragma omp simd reduction(| : any)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t i = block + lane;
      const Encounter e = encounter_of<partner>(c, i, b, u);
      const bool touching = e.x * e.x + e.y * e.y < e.reach * e.reach;
      const Touch t = touch(e, normal, slip, mu, attraction, u.dt);
      carry_on<partner>(c, i, touching, e, t, u);
      const double size = kick_bodies<partner>(c, i, touching, t, u);
      // Kicks are integers: what is not a number, or beyond all bounds, must not become one.
      const std::int64_t bad = size < 0x1p62 ? 0 : unusable;
      const std::int64_t over = touching ? 0 : apart;
      c.flags[i] = over | bad;
      any |= c.reach[i] > 0.0 ? over | bad : 0;  // no lane of the padding
    }
    c.block_flags[block / lanes] = any;
  }
}

}  // namespace

LiveContacts::Columns LiveContacts::columns() {
  Columns c{.first = body_[0].data(),
            .second = body_[1].data(),
            .line = wall_place_[0].data(),
            .y = wall_place_[1].data(),
            .reach = reach_.data(),
            .reduced_mass = reduced_mass_.data(),
            .per_mass_first = per_mass_[0].data(),
            .per_mass_second = per_mass_[1].data(),
            .life = {},
            .kick = {},
            .flags = flags_.data(),
            .block_flags = block_flags_.data()};
  std::transform(life_.begin(), life_.end(), c.life.begin(), [](auto& a) { return a.data(); });
  std::transform(kick_.begin(), kick_.end(), c.kick.begin(), [](auto& a) { return a.data(); });
  return c;
}

Contact LiveContacts::contact(std::size_t i) const {
  auto words = std::bit_cast<Words>(Contact{.name = meetings_[i].name});
  for (std::size_t m = 0; m < life_members; ++m) words[life_begin + m] = life_[m][i];
  return seen_from(meetings_[i], std::bit_cast<Contact>(words));
}

template <class Visit>
void LiveContacts::for_each_array(Visit visit) {
  for (auto& a : body_) visit(a);
  for (auto& a : wall_place_) visit(a);
  visit(reach_);
  visit(reduced_mass_);
  for (auto& a : per_mass_) visit(a);
  for (auto& a : life_) visit(a);
  for (auto& a : kick_) visit(a);
  visit(flags_);
}

/// Room for whole vectors; what is beyond size() is zero.
void LiveContacts::pad() {
  const std::size_t room = (size() / lanes + 1) * lanes;
  if (reach_.size() >= room) return;
  for_each_array([&](auto& a) { a.resize(2 * room); });
  block_flags_.resize(2 * room / lanes);
}

void LiveContacts::clear() {
  meetings_.clear();
  beginning_ = 0;
  for_each_array([](auto& a) { std::fill(a.begin(), a.end(), 0); });
}

void LiveContacts::add(const Meeting& meeting, const Contact& contact) {
  const std::size_t i = size();
  meetings_.push_back(meeting);
  pad();
  body_[0][i] = meeting.first;
  body_[1][i] = meeting.second;
  wall_place_[0][i] = meeting.line;
  wall_place_[1][i] = meeting.y;
  reach_[i] = meeting.reach;
  const double a = meeting.mass_first, b = meeting.mass_second;
  reduced_mass_[i] = partner_ == Partner::grain ? a * b / (a + b) : a;
  per_mass_[0][i] = 1.0 / a;
  per_mass_[1][i] = partner_ == Partner::grain ? 1.0 / b : 0.0;
  const auto words = std::bit_cast<Words>(seen_from(meeting, contact));
  for (std::size_t m = 0; m < life_members; ++m) life_[m][i] = words[life_begin + m];
}

void LiveContacts::remove(std::size_t i) {
  const std::size_t last = size() - 1;
  meetings_[i] = meetings_[last];
  meetings_.pop_back();
  for_each_array([&](auto& a) {
    a[i] = a[last];
    a[last] = 0;
  });
}

template <LiveContacts::Partner partner, class Normal, class Slip>
void LiveContacts::step(const Bodies& bodies, const StepUnits& units, const ContactModel& model,
                        const Normal& normal, const Slip& slip) {
  const Columns c = columns();
  for (std::size_t i = size() - beginning_; i < size(); ++i) {
    const Touch t = touch(encounter_of<partner>(c, i, bodies, units), normal, slip, model.friction,
                          model.attraction, units.dt);
    c.life[RIESEL_LIFE(begin)][i] = units.time - t.since;
    c.life[RIESEL_LIFE(entry_rate)][i] = t.rate;
    c.life[RIESEL_LIFE(entry_slip)][i] = t.slip;
  }
  beginning_ = 0;
  step_lanes<partner, lanes>(c, (size() + lanes - 1) / lanes * lanes, bodies, units, normal, slip,
                             model.friction, model.attraction);
}

void LiveContacts::step(const Bodies& bodies, const StepUnits& units, const ContactModel& model) {
  ended_.clear();
  if (size() == 0) return;
  std::visit(
      [&](const auto& normal, const auto& slip) {
        if (partner_ == Partner::grain)
          step<Partner::grain>(bodies, units, model, normal, slip);
        else
          step<Partner::wall>(bodies, units, model, normal, slip);
      },
      model.normal, model.slip);
  for (std::size_t block = 0; block < size(); block += lanes) {
    if (block_flags_[block / lanes] == 0) continue;
    for (std::size_t i = block; i < std::min(block + lanes, size()); ++i) {
      if ((flags_[i] & apart) != 0) ended_.push_back(i);
      if ((flags_[i] & unusable) != 0) trouble_ = meetings_[i].name;
    }
  }
  std::reverse(ended_.begin(), ended_.end());
}

}  // namespace riesel
