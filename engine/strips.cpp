#include "engine/strips.hpp"

#include "engine/exact_sums.hpp"
#include "engine/present_forces.hpp"
#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace riesel {

namespace {

using Sums = std::array<ExactSum, strip_sums>;

void add(Sums& sums, StripSum which, double term) {
  sums[static_cast<std::size_t>(which)].add(term);
}

/// Grains are taken this many at a time, so that vector stores are complete before their parts are
/// read again.
constexpr std::size_t at_a_time = 32;

/// The sums over the motion of the grains in a strip: those from StripSum::grains on. That of spins
/// is in radians per step here, as spins of small grains may exceed ExactSum's range.
constexpr std::size_t motion_sums =
    static_cast<std::size_t>(StripSum::contact_xx) - static_cast<std::size_t>(StripSum::grains);
using MotionSums = ExactSums<motion_sums>;

RIESEL_VECTOR_KERNEL std::vector<MotionSums>
sums_over_motion(const Strips& strips, const State& state, const Frame& frame) {
  std::vector<MotionSums> sums(strips.count + 1);
  const GrainView grains(state);
  std::array<std::array<double, motion_sums>, at_a_time> terms;
  std::array<std::size_t, at_a_time> strip;
  for (std::size_t begin = 0; begin < state.grains.size(); begin += at_a_time) {
    const std::size_t count = std::min(at_a_time, state.grains.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const Grain g = grains[begin + i];
      strip[i] = strips.at(g.x);
      const double u = g.vx - frame.vx, w = g.vy - frame.vy;
      const double z = g.x / strips.width - (static_cast<double>(strip[i]) + 0.5);
      const double m = g.mass, gyration2 = state.grains.inertia * g.radius * g.radius;
      terms[i] = {1.0,
                  g.vy,
                  u * u,
                  w,
                  w * w,
                  z,
                  z * z,
                  z * w,
                  g.spin * state.time_step,
                  gyration2,
                  gyration2 * g.spin,
                  gyration2 * g.spin * g.spin,
                  m,
                  m * g.vx * g.vx,
                  m * g.vx * w,
                  m * w,
                  m * w * w,
                  m * z,
                  m * z * z,
                  m * z * w};
    }
    for (std::size_t i = 0; i < count; ++i) sums[strip[i]].add(terms[i]);
  }
  return sums;
}

/// arccos x for |x| <= 1 with an error of 2e-8, which is no matter for area fractions: Abramowitz
/// and Stegun, 4.4.46.
[[gnu::always_inline]] inline double arc_cosine(double x) {
  const double a = std::abs(x);
  double sum = -0.0012624911;
  sum = sum * a + 0.0066700901;
  sum = sum * a - 0.0170881256;
  sum = sum * a + 0.0308918810;
  sum = sum * a - 0.0501743046;
  sum = sum * a + 0.0889789874;
  sum = sum * a - 0.2145988016;
  sum = sum * a + 1.5707963050;
  const double angle = std::sqrt(1.0 - a) * sum;
  return x < 0.0 ? std::numbers::pi - angle : angle;
}

/// area_left_of(), for vector loops.
[[gnu::always_inline]] inline double segment(double line, double radius) {
  const double h = std::min(std::max(line / radius, -1.0), 1.0);
  return radius * radius * (std::numbers::pi - arc_cosine(h) + h * std::sqrt(1.0 - h * h));
}

/// Up to at_a_time grains: x and radius (m), x of the line at which the first strip ends that the
/// disc covers, and the area (m^2) to the left of that line.
struct SomeGrains {
  std::array<double, at_a_time> x, radius, line, left;
};

RIESEL_VECTOR_KERNEL void cut_off(SomeGrains& g) {
#pragma omp simd
  for (std::size_t i = 0; i < at_a_time; ++i) g.left[i] = segment(g.line[i] - g.x[i], g.radius[i]);
}

/// Adds to each strip the area that it has of the disc; `left` (m^2) is that in the first strip,
/// unless the disc is in this strip alone.
void add_area(std::vector<Sums>& sums, const Strips& strips, double x, double radius, double left) {
  const std::size_t first = strips.at(x - radius), last = strips.at(x + radius);
  double so_far = 0.0;
  for (std::size_t s = first; s < last; ++s) {
    const double up_to_here =
        s == first ? left : area_left_of(static_cast<double>(s + 1) * strips.width - x, radius);
    add(sums[s], StripSum::area, up_to_here - so_far);
    so_far = up_to_here;
  }
  add(sums[last], StripSum::area, std::numbers::pi * radius * radius - so_far);
}

void add_areas(std::vector<Sums>& sums, const Strips& strips, const State& state) {
  SomeGrains g{};
  g.radius.fill(1.0);  // unused elements must not divide 0 by 0
  for (std::size_t begin = 0; begin < state.grains.size(); begin += at_a_time) {
    const std::size_t count = std::min(at_a_time, state.grains.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      g.x[i] = state.box.metres_x(state.grains.position[begin + i].x);
      g.radius[i] = state.grains.radius[begin + i];
      g.line[i] = static_cast<double>(strips.at(g.x[i] - g.radius[i]) + 1) * strips.width;
    }
    cut_off(g);
    for (std::size_t i = 0; i < count; ++i) add_area(sums, strips, g.x[i], g.radius[i], g.left[i]);
  }
}

void add_contact(Sums& sums, const PresentForce& f, double part) {
  add(sums, StripSum::contact_xx, part * f.branch_x * f.fx);
  add(sums, StripSum::contact_xy, part * f.branch_x * f.fy);
  add(sums, StripSum::contact_yx, part * f.branch_y * f.fx);
  add(sums, StripSum::contact_yy, part * f.branch_y * f.fy);
}

/// Adds to each strip the part of the line between the centres that lies in it.
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
          .count = static_cast<std::size_t>(count),
          .open = state.walls.size() == 1};
}

std::vector<double> Strips::middles() const {
  std::vector<double> x(count);
  for (std::size_t strip = 0; strip < count; ++strip)
    x[strip] = (static_cast<double>(strip) + 0.5) * width;
  return x;
}

std::size_t Strips::at(double x) const {
  const double place = std::clamp(x / width, 0.0, static_cast<double>(open ? count : count - 1));
  return static_cast<std::size_t>(place);
}

double area_left_of(double line, double radius) { return segment(line, radius); }

std::vector<double> sum_over_strips(const Strips& strips, const State& state,
                                    const ContactModel& model, const Frame& frame) {
  std::vector<Sums> sums(strips.count + 1);  // the last one is of what is in no strip
  add_areas(sums, strips, state);
  const std::vector<MotionSums> motion = sums_over_motion(strips, state, frame);
  for (std::size_t s = 0; s < sums.size(); ++s)
    for (std::size_t i = 0; i < motion_sums; ++i)
      sums[s][static_cast<std::size_t>(StripSum::grains) + i].add(motion[s].sum(i));
  for (const PresentForce& force : present_forces(state, model)) add_contact(sums, strips, force);

  sums.pop_back();
  std::vector<double> values;
  values.reserve(strips.columns());
  for (const Sums& strip : sums)
    for (const ExactSum& sum : strip) values.push_back(sum.value());
  for (std::size_t s = 0; s < strips.count; ++s)
    values[Strips::column(s, StripSum::spin)] /= state.time_step;
  return values;
}

}  // namespace riesel
