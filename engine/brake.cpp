#include "engine/brake.hpp"

#include "engine/closed_forms.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

namespace {

/// s, duration of a head-on contact. An overdamped one has none, as it creeps apart: then that
/// without damping.
double undisturbed_time(const ContactModel& model, double mass, double speed) {
  const auto linear = linear_contact(model.normal, mass);
  if (linear && !linear->rebounds())
    return elastic_collision_time(elastic_line(model.normal), mass, speed);
  return collision_time(model.normal, mass, speed, model.attraction);
}

/// The s at which F_N changes its sign in the second half of overlap = 4 depth s (1 - s), 0 < s <
/// 1, where s is the time over `duration`; by bisection.
template <class Normal>
double sign_change(const Normal& normal, double mass, double depth, double duration) {
  const auto pushes = [&](double s) {
    const double overlap = 4.0 * depth * s * (1.0 - s);
    const double rate = 4.0 * depth * (1.0 - 2.0 * s) / duration;
    return normal.elastic(overlap) + normal.damping(overlap, rate, mass) >= 0.0;
  };
  double pushing = 0.5, pulling = 1.0;
  for (int i = 0; i < 12; ++i) {  // to 1e-4 of the duration
    const double middle = 0.5 * (pushing + pulling);
    (pushes(middle) ? pushing : pulling) = middle;
  }
  return pulling;
}

}  // namespace

bool is_cut_short(const Contact& contact, const ContactModel& model, double mass) {
  // A contact of one or two steps may be separating already when it is first seen: hence the size.
  const double speed = std::max(std::abs(contact.entry_rate), 1e-9);  // m/s
  return contact.duration() < cut_short_below * undisturbed_time(model, mass, speed);
}

double pulling_time(const Contact& contact, const ContactModel& model, double mass) {
  const double duration = contact.duration();
  if (model.attraction == Attraction::clip || duration <= 0.0 || contact.max_overlap <= 0.0)
    return 0.0;
  return std::visit(
      [&](const auto& normal) {
        return duration * (1.0 - sign_change(normal, mass, contact.max_overlap, duration));
      },
      model.normal);
}

void BrakeTally::add(const Contact& contact, const ContactModel& model, double mass, bool smooth) {
  const double braking_impulse = std::max(0.0, -contact.impulse_y);
  ++contacts;
  braking.add(braking_impulse);
  friction_loss.add(contact.friction_loss);
  entry_slip.add(std::abs(contact.entry_slip));
  duration.add(contact.duration());
  pulling.add(pulling_time(contact, model, mass));
  if (smooth || !is_cut_short(contact, model, mass)) return;
  ++cut_short;
  braking_cut_short.add(braking_impulse);
  friction_loss_cut_short.add(contact.friction_loss);
}

}  // namespace riesel
