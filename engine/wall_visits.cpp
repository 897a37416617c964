#include "engine/wall_visits.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace riesel {

namespace {

/// (m/s)^2, relative to the wall. In the frame of a wall at rest or at constant velocity, what a
/// grain without rotation has lost is what was dissipated; for an oscillating wall, and for grains
/// that rotate, this is an approximation.
double leaving_speed_squared(const Contact& c, double mass) {
  const double entry2 = c.entry_rate * c.entry_rate + c.entry_slip * c.entry_slip;
  return std::max(entry2 - 2.0 * (c.normal_loss + c.friction_loss) / mass, 0.01 * entry2);
}

}  // namespace

Span visit_span(const Contact& contact, double mass, double spacing, double gravity) {
  const double speed2 = leaving_speed_squared(contact, mass);
  const double path = 2.0 * spacing;
  if (path == 0.0) return {contact.begin, contact.end};
  // spacing = speed t + gravity t^2 / 2
  const double time = path / (std::sqrt(speed2) + std::sqrt(speed2 + path * std::abs(gravity)));
  return {contact.begin, contact.end + time};
}

WallVisit::WallVisit(const Contact& contact, const Span& its_span)
    : wall(contact.name.wall),
      grain(contact.name.grain),
      span(its_span),
      contacts(1),
      entry_rate(contact.entry_rate),
      entry_slip(std::abs(contact.entry_slip)) {
  impulse_x.add(contact.impulse_x);
  impulse_y.add(contact.impulse_y);
}

void WallVisit::join(const WallVisit& other) {
  // Two contacts may begin at the same time: then any rule is right that does not depend on the
  // order of joining.
  const auto entry = [](const WallVisit& v) {
    return std::tie(v.span.begin, v.entry_rate, v.entry_slip);
  };
  if (entry(other) < entry(*this)) {
    span.begin = other.span.begin;
    entry_rate = other.entry_rate;
    entry_slip = other.entry_slip;
  }
  span.end = std::max(span.end, other.span.end);
  contacts += other.contacts;
  impulse_x.add(other.impulse_x);
  impulse_y.add(other.impulse_y);
}

std::int64_t VisitTally::visits() const {
  return std::accumulate(of_contacts.begin(), of_contacts.end(), std::int64_t{0});
}

void VisitTally::add(const WallVisit& visit, double mass, double away) {
  const auto count = static_cast<std::size_t>(visit.contacts);
  ++of_contacts[std::min(count, longest) - 1];
  contacts += visit.contacts;
  dv_y.add(-visit.impulse_y.value() / mass);
  dv_x.add(away * visit.impulse_x.value() / mass);
  entry_rate.add(visit.entry_rate);
  entry_slip.add(visit.entry_slip);
  entry_rates.add(visit.entry_rate);
  entry_slips.add(visit.entry_slip);
}

}  // namespace riesel
