#include "engine/strips.hpp"

#include "engine/present_forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace riesel {

namespace {

using Sums = std::array<ExactSum, strip_sums>;

void add(Sums& sums, StripSum which, double term) {
  sums[static_cast<std::size_t>(which)].add(term);
}

void add_motion(Sums& sums, const Grain& g, double frame) {
  const double w = g.vy - frame;
  add(sums, StripSum::grains, 1.0);
  add(sums, StripSum::vy, g.vy);
  add(sums, StripSum::vx2, g.vx * g.vx);
  add(sums, StripSum::w, w);
  add(sums, StripSum::w2, w * w);
  add(sums, StripSum::mass, g.mass);
  add(sums, StripSum::mass_vx2, g.mass * g.vx * g.vx);
  add(sums, StripSum::mass_vx_w, g.mass * g.vx * w);
  add(sums, StripSum::mass_w, g.mass * w);
  add(sums, StripSum::mass_w2, g.mass * w * w);
}

void add_area(std::vector<Sums>& sums, const Strips& strips, const Grain& g) {
  const std::size_t first = strips.at(g.x - g.radius), last = strips.at(g.x + g.radius);
  double left = 0.0;
  for (std::size_t s = first; s < last; ++s) {
    const double up_to_here =
        area_left_of(static_cast<double>(s + 1) * strips.width - g.x, g.radius);
    add(sums[s], StripSum::area, up_to_here - left);
    left = up_to_here;
  }
  add(sums[last], StripSum::area, std::numbers::pi * g.radius * g.radius - left);
}

void add_contact(Sums& sums, const PresentForce& f, double part) {
  add(sums, StripSum::contact_xx, part * f.branch_x * f.fx);
  add(sums, StripSum::contact_xy, part * f.branch_x * f.fy);
  add(sums, StripSum::contact_yx, part * f.branch_y * f.fx);
  add(sums, StripSum::contact_yy, part * f.branch_y * f.fy);
}

/// Each strip gets the part of the line between the centres that lies in it.
void add_contact(std::vector<Sums>& sums, const Strips& strips, const PresentForce& f) {
  const auto [low, high] = std::minmax({f.x, f.x - f.branch_x});
  const std::size_t first = strips.at(low), last = strips.at(high);
  double begin = low;
  for (std::size_t s = first; s < last; ++s) {
    const double end = static_cast<double>(s + 1) * strips.width;
    add_contact(sums[s], f, (end - begin) / (high - low));
    begin = end;
  }
  add_contact(sums[last], f, first == last ? 1.0 : (high - begin) / (high - low));
}

}  // namespace

Strips Strips::of(const State& state) {
  const double wanted = std::nearbyint(state.box.width / mean_diameter(state.grains));
  const double count = std::clamp(wanted, 1.0, 1e4);
  return {.width = state.box.width / count,
          .length = state.box.length,
          .count = static_cast<std::size_t>(count)};
}

std::vector<double> Strips::middles() const {
  std::vector<double> x(count);
  for (std::size_t strip = 0; strip < count; ++strip)
    x[strip] = (static_cast<double>(strip) + 0.5) * width;
  return x;
}

std::size_t Strips::at(double x) const {
  const double place = std::clamp(x / width, 0.0, static_cast<double>(count - 1));
  return static_cast<std::size_t>(place);
}

double area_left_of(double line, double radius) {
  const double h = std::clamp(line / radius, -1.0, 1.0);
  return radius * radius * (std::numbers::pi - std::acos(h) + h * std::sqrt(1.0 - h * h));
}

std::vector<double> sum_over_strips(const Strips& strips, const State& state,
                                    const ContactModel& model, double frame) {
  std::vector<Sums> sums(strips.count);
  const GrainView grains(state);
  for (std::size_t slot = 0; slot < state.grains.size(); ++slot) {
    const Grain grain = grains[slot];
    add_motion(sums[strips.at(grain.x)], grain, frame);
    add_area(sums, strips, grain);
  }
  for (const PresentForce& force : present_forces(state, model)) add_contact(sums, strips, force);

  std::vector<double> values;
  values.reserve(strips.columns());
  for (const Sums& strip : sums)
    for (const ExactSum& sum : strip) values.push_back(sum.value());
  return values;
}

}  // namespace riesel
