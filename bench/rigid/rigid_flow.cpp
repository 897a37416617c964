#include "bench/rigid/rigid_flow.hpp"

#include "bench/rigid/first_touch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>

namespace riesel::bench {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

void reject_unless(bool known, const char* what) {
  if (!known) throw std::invalid_argument(std::string("rigid grains: ") + what);
}

}  // namespace

RigidFlow::RigidFlow(const State& state, const ContactModel& model, double shortest_interval)
    : box_(state.box),
      gravity_(state.gravity.y),
      mu_(model.friction),
      shortest_interval_(shortest_interval),
      law_(),
      attraction_(model.attraction),
      next_(state.grains.size()) {
  reject_unless(std::holds_alternative<LinearLaw>(model.normal),
                "contact.law is not linear, or contact.restitution_of is all");
  reject_unless(std::holds_alternative<CappedSlip>(model.slip), "contact.slip is not cap");
  reject_unless(!state.grains.rotate(), "grains rotate");
  reject_unless(state.gravity.x == 0.0, "gravity pulls across the tube");
  law_ = std::get<LinearLaw>(model.normal);
  for (const WallLattice& wall : state.walls) {
    reject_unless(!wall.smooth() && !wall.motion.is_ever_away(), "a wall is smooth or moves");
    walls_.push_back({wall.line, wall.radius, wall.spacing(state.box)});
  }

  double largest = 0.0;
  for (const std::size_t slot : slots_by_id(state.grains)) {
    const Grain g = grain_at(state, slot);
    discs_.push_back({.x = g.x,
                      .y = g.y,
                      .ux = g.vx,
                      .uy = g.vy,
                      .since = 0.0,
                      .radius = g.radius,
                      .mass = g.mass,
                      .last_impact = -never,
                      .column = 0,
                      .row = 0,
                      .next = nobody,
                      .previous = nobody,
                      .partner = nobody,
                      .impacts = 0,
                      .partners_impacts = 0,
                      .wall = {}});
    largest = std::max(largest, 2.0 * g.radius);
  }
  columns_ = static_cast<std::int64_t>(box_.width / largest);
  rows_ = static_cast<std::int64_t>(box_.length / largest);
  reject_unless(columns_ >= 3 && rows_ >= 3, "the box is too small");
  cell_x_ = box_.width / static_cast<double>(columns_);
  cell_y_ = box_.length / static_cast<double>(rows_);
}

void RigidFlow::advance(double duration) {
  end_ = duration;
  enter_frame();
  while (next_.time_of_first() < end_) {
    now_ = next_.time_of_first();
    happen(next_.first());
  }
  leave_frame(duration);
}

Grain RigidFlow::grain(std::size_t i) const {
  const Disc& disc = discs_[i];
  return {.x = disc.x,
          .y = disc.y,
          .vx = disc.ux,
          .vy = disc.uy,
          .radius = disc.radius,
          .mass = disc.mass};
}

// --- The frame ---

/// Between two advances discs are seen from the tube, at the time 0.
void RigidFlow::enter_frame() {
  now_ = 0.0;
  frame_velocity_ = 0.0;
  for (const Disc& disc : discs_) frame_velocity_ += disc.uy / static_cast<double>(discs_.size());
  first_in_cell_.assign(static_cast<std::size_t>(columns_ * rows_), nobody);
  for (std::size_t i = 0; i < discs_.size(); ++i) {
    Disc& disc = discs_[i];
    disc.uy -= frame_velocity_;
    disc.column = std::clamp(static_cast<std::int64_t>(std::floor(disc.x / cell_x_)),
                             std::int64_t{0}, columns_ - 1);
    disc.row = static_cast<std::int64_t>(std::floor(disc.y / cell_y_));
    take_place(i);
  }
  for (std::size_t i = 0; i < discs_.size(); ++i) foresee(i);
}

void RigidFlow::leave_frame(double duration) {
  now_ = duration;
  for (Disc& disc : discs_) {
    come_to_now(disc);
    disc.since = 0.0;
    disc.last_impact -= duration;
    disc.uy += frame_velocity_ + gravity_ * duration;
    disc.y += (frame_velocity_ + 0.5 * gravity_ * duration) * duration;
    disc.y = box_.wrapped(disc.y);
  }
}

void RigidFlow::come_to_now(Disc& disc) const {
  disc.x += disc.ux * (now_ - disc.since);
  disc.y += disc.uy * (now_ - disc.since);
  disc.since = now_;
}

// --- Cells ---

std::size_t RigidFlow::cell_of(const Disc& disc) const {
  const std::int64_t row = (disc.row % rows_ + rows_) % rows_;
  return static_cast<std::size_t>(row * columns_ + disc.column);
}

void RigidFlow::take_place(std::size_t i) {
  std::size_t& first = first_in_cell_[cell_of(discs_[i])];
  discs_[i].previous = nobody;
  discs_[i].next = first;
  if (first != nobody) discs_[first].previous = i;
  first = i;
}

void RigidFlow::leave_place(std::size_t i) {
  const Disc& disc = discs_[i];
  if (disc.next != nobody) discs_[disc.next].previous = disc.previous;
  (disc.previous != nobody ? discs_[disc.previous].next : first_in_cell_[cell_of(disc)]) =
      disc.next;
}

// --- What happens ---

void RigidFlow::happen(std::size_t i) {
  Disc& disc = discs_[i];
  if (disc.wall.touches)
    touch_wall(i);
  else if (disc.partner == nobody)
    change_cell(i);
  else if (discs_[disc.partner].impacts == disc.partners_impacts)
    meet(i, disc.partner);
  else  // the partner has met somebody else before
    foresee(i);
}

/// Or only looks how its way along the wall goes on.
void RigidFlow::change_cell(std::size_t i) {
  Disc& disc = discs_[i];
  come_to_now(disc);
  leave_place(i);
  const double x = disc.x - cell_x_ * (static_cast<double>(disc.column) + 0.5);
  const double y = disc.y - cell_y_ * (static_cast<double>(disc.row) + 0.5);
  // Rounding may leave it a hair before the border, hence the direction.
  constexpr double at_border = 0.5 - 1e-9;
  if (std::abs(x) > at_border * cell_x_ && x * disc.ux > 0.0)
    disc.column = std::clamp(disc.column + (x > 0.0 ? 1 : -1), std::int64_t{0}, columns_ - 1);
  if (std::abs(y) > at_border * cell_y_ && y * disc.uy > 0.0) disc.row += y > 0.0 ? 1 : -1;
  take_place(i);
  foresee(i);
}

ImpactRule RigidFlow::rule_for(const Disc& disc, double last_impact, double reduced_mass) {
  if (now_ - std::max(disc.last_impact, last_impact) < shortest_interval_) {
    ++counts_.elastic;
    return {.restitution = 1.0, .grip = 2.0 * mu_};
  }
  return rigid_limit({law_.k_n, law_.gamma_n, reduced_mass, attraction_}, mu_);
}

void RigidFlow::meet(std::size_t i, std::size_t j) {
  Disc &a = discs_[i], &b = discs_[j];
  come_to_now(a);
  come_to_now(b);
  const double dx = b.x - a.x;
  double dy = b.y - a.y;
  dy -= box_.length * std::nearbyint(dy / box_.length);
  const double distance = std::hypot(dx, dy);
  const double reduced_mass = a.mass * b.mass / (a.mass + b.mass);
  const Impulse impulse = impulse_of(rule_for(a, b.last_impact, reduced_mass), reduced_mass,
                                     dx / distance, dy / distance, b.ux - a.ux, b.uy - a.uy);
  a.ux += impulse.x / a.mass;
  a.uy += impulse.y / a.mass;
  b.ux -= impulse.x / b.mass;
  b.uy -= impulse.y / b.mass;
  ++counts_.impacts;
  for (Disc* one : {&a, &b}) {
    one->last_impact = now_;
    ++one->impacts;
  }
  foresee(i);
  foresee(j);
}

void RigidFlow::touch_wall(std::size_t i) {
  Disc& disc = discs_[i];
  come_to_now(disc);
  const double distance = std::hypot(disc.wall.x, disc.wall.y);
  const double wall_uy = -(frame_velocity_ + gravity_ * now_);
  const Impulse impulse =
      impulse_of(rule_for(disc, -never, disc.mass), disc.mass, disc.wall.x / distance,
                 disc.wall.y / distance, -disc.ux, wall_uy - disc.uy);
  disc.ux += impulse.x / disc.mass;
  disc.uy += impulse.y / disc.mass;
  disc.last_impact = now_;
  ++disc.impacts;
  ++counts_.wall_impacts;
  counts_.wall_impulse_y += impulse.y;
  foresee(i);
}

// --- What will happen ---

/// Its next event, as things are now. Who is hit meanwhile foresees anew; that its partner has been
/// is noticed when they would meet.
void RigidFlow::foresee(std::size_t i) {
  Disc& disc = discs_[i];
  come_to_now(disc);
  disc.partner = nobody;
  disc.wall.touches = false;
  double soonest = std::min(leaves_cell(disc), end_ - now_);

  const std::int64_t from = std::max(disc.column - 1, std::int64_t{0});
  const std::int64_t to = std::min(disc.column + 1, columns_ - 1);
  for (std::int64_t row = disc.row - 1; row <= disc.row + 1; ++row) {
    const std::int64_t line = (row % rows_ + rows_) % rows_ * columns_;
    for (std::int64_t cell = line + from; cell <= line + to; ++cell)
      for (std::size_t j = first_in_cell_[static_cast<std::size_t>(cell)]; j != nobody;
           j = discs_[j].next) {
        if (j == i) continue;
        const double time = meets(disc, discs_[j], row);
        if (time >= soonest) continue;
        soonest = time;
        disc.partner = j;
        disc.partners_impacts = discs_[j].impacts;
      }
  }
  for (const Wall& wall : walls_)
    if (const std::optional<WallEvent> event = meets_wall(disc, wall, soonest)) {
      soonest = event->time;
      disc.partner = nobody;
      disc.wall = *event;
    }
  next_.set(i, now_ + soonest);
}

/// s from now.
double RigidFlow::leaves_cell(const Disc& disc) const {
  const auto from = [](double place, double cell, std::int64_t number, double u) {
    if (u == 0.0) return never;
    const auto border = static_cast<double>(u > 0.0 ? number + 1 : number) * cell;
    return std::max(0.0, (border - place) / u);
  };
  const double up_or_down = from(disc.y, cell_y_, disc.row, disc.uy);
  const bool towards_wall = disc.ux > 0.0 ? disc.column == columns_ - 1 : disc.column == 0;
  if (towards_wall) return up_or_down;
  return std::min(from(disc.x, cell_x_, disc.column, disc.ux), up_or_down);
}

/// s from now; `never` if they do not. `row` is that of the other one's nearest image.
double RigidFlow::meets(const Disc& disc, const Disc& other, std::int64_t row) const {
  const double age = now_ - other.since;
  const double periods = static_cast<double>(row - other.row) * cell_y_;
  const double dx = other.x + other.ux * age - disc.x;
  const double dy = other.y + other.uy * age + periods - disc.y;
  const double ux = other.ux - disc.ux, uy = other.uy - disc.uy;
  const double closing = -(dx * ux + dy * uy);
  if (closing <= 0.0) return never;
  const double reach = disc.radius + other.radius;
  const double apart = dx * dx + dy * dy - reach * reach, u2 = ux * ux + uy * uy;
  if (apart <= 0.0) return 0.0;
  const double square = closing * closing - u2 * apart;
  if (square <= 0.0) return never;
  return apart / (closing + std::sqrt(square));
}

/// A way along the wall is looked at in pieces: nothing, or when it touches, or until when it does
/// not.
std::optional<RigidFlow::WallEvent> RigidFlow::meets_wall(const Disc& disc, const Wall& wall,
                                                          double within) const {
  const double reach = disc.radius + wall.radius, x = disc.x - wall.line;
  // While |x + ux t| < reach: from `begin` to `end`.
  double begin = 0.0, end = within;
  if (disc.ux != 0.0) {
    const double one = (-reach - x) / disc.ux, another = (reach - x) / disc.ux;
    begin = std::max(begin, std::min(one, another));
    end = std::min(end, std::max(one, another));
  } else if (std::abs(x) >= reach) {
    return std::nullopt;
  }
  if (begin >= end) return std::nullopt;

  // y along the tube is y + v t + half_g t^2, with t from `begin` on.
  const double start = now_ + begin, half_g = 0.5 * gravity_;
  const double x_begin = x + disc.ux * begin;
  const double y = disc.y + disc.uy * begin + (frame_velocity_ + half_g * start) * start;
  const double v = disc.uy + frame_velocity_ + gravity_ * start;
  const double piece = 2.0 * wall.spacing / (std::abs(v) + std::sqrt(gravity_ * wall.spacing));
  const double span = std::min(piece, end - begin);
  const double there = y + (v + half_g * span) * span;
  const double turn = v < 0.0 && -v < gravity_ * span ? y - 0.5 * v * v / gravity_ : y;
  const double lowest = std::min(turn, there) - reach, highest = std::max(y, there) + reach;

  WallEvent event{.time = begin + span, .touches = false, .x = 0.0, .y = 0.0};
  const auto last = static_cast<std::int64_t>(std::floor(highest / wall.spacing));
  for (auto k = static_cast<std::int64_t>(std::ceil(lowest / wall.spacing)); k <= last; ++k) {
    const double dy = y - static_cast<double>(k) * wall.spacing;
    const Polynomial<5> apart{
        {x_begin * x_begin + dy * dy - reach * reach, 2.0 * (x_begin * disc.ux + dy * v),
         disc.ux * disc.ux + v * v + 2.0 * dy * half_g, 2.0 * v * half_g, half_g * half_g}};
    const std::optional<double> time = first_touch(apart, event.time - begin);
    if (!time) continue;
    event = {.time = begin + *time,
             .touches = true,
             .x = -(x_begin + disc.ux * *time),
             .y = -(dy + (v + half_g * *time) * *time)};
  }
  return event.touches || span < end - begin ? std::optional(event) : std::nullopt;
}

}  // namespace riesel::bench
