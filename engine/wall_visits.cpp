#include "engine/wall_visits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace riesel {

namespace {

/// (m/s)^2; the wall does not move, so that what the grain has lost is what was dissipated.
double leaving_speed_squared(const Contact& c, double mass) {
  const double entry2 = c.entry_rate * c.entry_rate + c.entry_slip * c.entry_slip;
  return std::max(entry2 - 2.0 * (c.normal_loss + c.friction_loss) / mass, 0.01 * entry2);
}

}  // namespace

Span visit_span(const Contact& contact, double mass, double spacing, double gravity) {
  const double speed2 = leaving_speed_squared(contact, mass);
  const double path = 2.0 * spacing;
  // spacing = speed t + gravity t^2 / 2
  const double time = path / (std::sqrt(speed2) + std::sqrt(speed2 + path * std::abs(gravity)));
  return {contact.begin, contact.end + time};
}

std::int64_t VisitTally::visits() const {
  return std::accumulate(of_contacts.begin(), of_contacts.end(), std::int64_t{0});
}

void VisitTally::add(std::span<const Contact> visit, double mass, double away) {
  double impulse_x = 0.0, impulse_y = 0.0;
  for (const Contact& contact : visit) {
    impulse_x += contact.impulse_x;
    impulse_y += contact.impulse_y;
  }
  ++of_contacts[std::min(visit.size(), longest) - 1];
  contacts += static_cast<std::int64_t>(visit.size());
  dv_y.add(-impulse_y / mass);
  dv_x.add(away * impulse_x / mass);
  entry_rate.add(visit.front().entry_rate);
  entry_slip.add(std::abs(visit.front().entry_slip));
}

void VisitTally::merge(const VisitTally& other) {
  std::transform(of_contacts.begin(), of_contacts.end(), other.of_contacts.begin(),
                 of_contacts.begin(), std::plus<>());
  contacts += other.contacts;
  dv_y.add(other.dv_y);
  dv_x.add(other.dv_x);
  entry_rate.add(other.entry_rate);
  entry_slip.add(other.entry_slip);
}

}  // namespace riesel
