// A second engine for tests: velocity Verlet in doubles that tries all pairs in every step.
//
// It has no cells, no candidates, no fixed point, no falling frame and no slots, and it forgets
// nothing: what the engine does to be fast must not show in the comparison. Only the formula of a
// single contact in a single step (touch) is the engine's own; that one is held against independent
// numbers in tests/physics.
#pragma once

#include "engine/encounter.hpp"
#include "engine/state.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <map>
#include <variant>
#include <vector>

namespace brute_force {

using namespace riesel;
using Eigen::Vector2d;

struct Body {
  Vector2d position;            ///< m
  Vector2d half_step_velocity;  ///< m/s
  Vector2d acceleration;        ///< m/s^2
  double radius, mass;
  Spin spin;               ///< rad/s
  double spin_rate = 0.0;  ///< rad/s^2
};

/// What was seen of one contact from its first to its last step.
struct Life {
  std::int64_t first_step, last_step;
  double max_overlap = 0.0;  ///< m
  double slip_path = 0.0;    ///< m
  double begin = 0.0;        ///< s
  double spring = 0.0;       ///< m, elongation
};

class Stepper {
public:
  /// Starts from a state at step 0.
  Stepper(const State& state, const ContactModel& model)
      : box_(state.box),
        walls_(state.walls),
        gravity_(state.gravity.x, state.gravity.y),
        dt_(state.time_step),
        model_(model),
        inertia_(state.grains.inertia),
        bodies_(state.grains.size()),
        impulse_of_wall_(walls_.size(), Vector2d::Zero()) {
    for (std::size_t slot = 0; slot < bodies_.size(); ++slot) {
      const Grain g = grain_at(state, slot);
      Body& body = bodies_[static_cast<std::size_t>(state.grains.id[slot])];
      body = {.position = {g.x, g.y},
              .half_step_velocity = Vector2d(g.vx, g.vy) - 0.5 * dt_ * gravity_,
              .acceleration = gravity_,
              .radius = g.radius,
              .mass = g.mass,
              .spin = {.now = g.spin, .half = g.spin}};
    }
  }

  void step() {
    ++step_;
    for (Body& body : bodies_) {
      body.half_step_velocity += dt_ * body.acceleration;
      body.position += dt_ * body.half_step_velocity;
      body.spin.half += dt_ * body.spin_rate;
      body.spin.now = body.spin.half + 0.5 * dt_ * body.spin_rate;
    }
    for (Body& body : bodies_) body.spin_rate = 0.0;
    std::vector<Vector2d> accelerations(bodies_.size(), gravity_);
    std::map<ContactName, Life> now;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies_.size(); ++j) {
        Body &a = bodies_[i], &b = bodies_[j];
        const auto t = try_touch(a, b, a.mass * b.mass / (a.mass + b.mass), name(-1, i, j), now);
        accelerations[i] += t / a.mass;
        accelerations[j] -= t / b.mass;
      }
      for (std::size_t w = 0; w < walls_.size(); ++w)
        for (std::int64_t k = 0; k < std::max<std::int64_t>(walls_[w].count, 1); ++k) {
          const auto who = name(static_cast<int>(w), i, static_cast<std::size_t>(k));
          Body fixed = wall_grain(walls_[w], k, bodies_[i].position.y());
          const auto t = try_touch(bodies_[i], fixed, bodies_[i].mass, who, now);
          accelerations[i] += t / bodies_[i].mass;
          impulse_of_wall_[w] += dt_ * t;
        }
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].acceleration = accelerations[i];
    for (const auto& [who, life] : touching_)
      if (!now.contains(who)) ended_.emplace_back(who, life);
    touching_ = std::move(now);
  }

  const Body& body(std::size_t id) const { return bodies_[id]; }
  const std::map<ContactName, Life>& touching() const { return touching_; }
  const std::vector<std::pair<ContactName, Life>>& ended() const { return ended_; }
  /// kg m/s, given to the grains since step 0.
  const Vector2d& impulse_of_wall(std::size_t wall) const { return impulse_of_wall_[wall]; }

  /// m, between a grain here and in `state`, the largest over all grains.
  double distance_to(const State& state) const {
    double largest = 0.0;
    for (std::size_t slot = 0; slot < bodies_.size(); ++slot) {
      const Grain g = grain_at(state, slot);
      const Body& body = bodies_[static_cast<std::size_t>(state.grains.id[slot])];
      largest = std::max({largest, std::abs(g.x - body.position.x()),
                          std::abs(std::remainder(g.y - body.position.y(), box_.length))});
    }
    return largest;
  }

private:
  static ContactName name(int wall, std::size_t grain, std::size_t partner) {
    return {wall, static_cast<std::int32_t>(grain), static_cast<std::int32_t>(partner)};
  }

  /// The place of a smooth wall that a grain at `level` (m) touches is level with it.
  Body wall_grain(const WallLattice& wall, std::int64_t k, double level) const {
    const double y = static_cast<double>(k) * box_.length / static_cast<double>(wall.count);
    const auto way = [&](std::int64_t step) {
      const WallWay gone = wall.motion.way(box_, static_cast<double>(step) * dt_);
      return Vector2d(gone.x, gone.y);
    };
    const Vector2d now = way(step_), before = now - way(step_ - 1), after = way(step_ + 1) - now;
    return {.position = {wall.line + now.x(), wall.smooth() ? level : y + now.y()},
            .half_step_velocity = before / dt_,
            .acceleration = (after - before) / (dt_ * dt_),
            .radius = wall.radius,
            .mass = 0.0,
            .spin = {}};
  }

  /// rad/s^2 per N m; 0: a wall grain, or no rotation.
  double per_inertia(const Body& body) const {
    return body.mass == 0.0 || inertia_ == 0.0
               ? 0.0
               : 1.0 / (inertia_ * body.mass * body.radius * body.radius);
  }

  /// The force on `a`, and an entry in `now` if the two overlap, which may begin to spin.
  Vector2d try_touch(Body& a, Body& b, double reduced_mass, const ContactName& who,
                     std::map<ContactName, Life>& now) {
    Vector2d separation = b.position - a.position;
    separation.y() = std::remainder(separation.y(), box_.length);
    const double reach = a.radius + b.radius;
    if (separation.norm() >= reach) return Vector2d::Zero();

    const Vector2d half_step = b.half_step_velocity - a.half_step_velocity;
    const Vector2d velocity = half_step + 0.5 * dt_ * (b.acceleration - a.acceleration);
    const Encounter e{separation.x(), separation.y(), velocity.x(),
                      velocity.y(),   half_step.x(),  half_step.y(),
                      reach,          reduced_mass,   1.0 / reduced_mass};
    const auto touch_of = [&](const auto& turn, const Stretch& stretch) {
      return std::visit(
          [&](const auto& normal, const auto& slip) {
            return touch(e, turn, stretch, normal, slip, model_.friction, model_.attraction, dt_);
          },
          model_.normal, model_.slip);
    };
    const auto touch_now = [&](const Stretch& stretch) {
      if (inertia_ == 0.0) return touch_of(NoTurning{}, stretch);
      const double i = a.radius / reach, j = b.radius / reach;
      return touch_of(Turning{.roll = i * a.spin.now + j * b.spin.now,
                              .half_roll = i * a.spin.half + j * b.spin.half,
                              .spin = a.spin.now - b.spin.now,
                              .half_spin = a.spin.half - b.spin.half,
                              .inertia = inertia_,
                              .part_first = i,
                              .part_second = j,
                              .per_inertia_first = per_inertia(a),
                              .per_inertia_second = per_inertia(b),
                              .rolling_arm = model_.rolling_friction
                                             * (b.radius > 0.0 ? i * b.radius : a.radius)},
                      stretch);
    };

    const auto before = touching_.find(who);
    const double time = static_cast<double>(step_) * dt_;
    Life life =
        before != touching_.end()
            ? before->second
            : Life{.first_step = step_, .last_step = step_, .begin = time - touch_now({}).since};
    const Touch t = touch_now({.spring = life.spring, .time = std::min(dt_, time - life.begin)});
    life.spring = t.spring;
    a.spin_rate += (a.radius / reach * t.torque + t.rolling_torque) * per_inertia(a);
    b.spin_rate += (b.radius / reach * t.torque - t.rolling_torque) * per_inertia(b);
    life.last_step = step_;
    life.max_overlap = std::max(life.max_overlap, reach - separation.norm());
    const Vector2d along_s(-separation.y(), separation.x());
    const double rolled = (a.radius * a.spin.now + b.radius * b.spin.now) / reach;
    life.slip_path +=
        dt_ * std::abs(velocity.dot(along_s) / separation.norm() - rolled * separation.norm());
    now[who] = life;
    return {t.fx, t.fy};
  }

  Box box_;
  std::vector<WallLattice> walls_;
  Vector2d gravity_;
  double dt_;
  ContactModel model_;
  double inertia_;                         // of a grain, over m r^2; 0: no rotation
  std::vector<Body> bodies_;               // by id
  std::vector<Vector2d> impulse_of_wall_;  // kg m/s, on the grains
  std::int64_t step_ = 0;
  std::map<ContactName, Life> touching_;
  std::vector<std::pair<ContactName, Life>> ended_;
};

}  // namespace brute_force
