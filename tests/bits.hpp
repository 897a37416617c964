// All that a state holds, bit by bit: also signs of zeros, by which numbers do not differ.
#pragma once

#include "engine/state.hpp"

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace riesel {

class Bits {
public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) { bits_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void add(const FixedVector& v) {
    add(v.x);
    add(v.y);
  }
  void add(const ExactSum& sum) {
    add(sum.high());
    add(sum.low());
  }
  template <class Vector>
  void add_all(const Vector& values) {
    add(values.size());
    for (const auto& value : values) add(value);
  }
  void add(const ContactTally& t) {
    add(t.begun);
    add(t.ended);
    add(t.max_overlap);
    for (const auto* sum : {&t.duration, &t.slip_path, &t.normal_loss, &t.friction_loss,
                            &t.energy_won, &t.impulse_y, &t.impulse_y_times_time}) {
      add(*sum);
    }
    add_all(t.durations.counts());
    add_all(t.overlaps.counts());
    add_all(t.deepest ? std::vector{*t.deepest} : std::vector<Contact>{});
  }
  void add(const BrakeTally& t) {
    add(t.contacts);
    add(t.cut_short);
    for (const auto* sum : {&t.braking, &t.braking_cut_short, &t.friction_loss,
                            &t.friction_loss_cut_short, &t.entry_slip, &t.duration, &t.pulling}) {
      add(*sum);
    }
  }
  void add(const VisitTally& t) {
    add_all(t.of_contacts);
    add(t.contacts);
    for (const auto* sum : {&t.dv_y, &t.dv_x, &t.entry_rate, &t.entry_slip}) add(*sum);
    add_all(t.entry_rates.counts());
    add_all(t.entry_slips.counts());
  }
  void add(const WallVisit& v) {
    add_all(std::vector{v.wall, v.grain});
    add_all(std::vector{v.span.begin, v.span.end, v.entry_rate, v.entry_slip});
    add(v.contacts);
    add(v.impulse_x);
    add(v.impulse_y);
  }
  void add(const Contact& c) {
    add_all(std::vector{c.name.wall, c.name.grain, c.name.partner});
    add_all(std::vector{c.begin, c.end, c.entry_rate, c.entry_slip, c.overlap, c.max_overlap,
                        c.slip_path, c.elastic_energy, c.normal_loss, c.friction_loss, c.impulse_x,
                        c.impulse_y, c.impulse_y_times_time, c.friction_x, c.friction_y, c.spring,
                        c.torque, c.rolling_torque});
  }
  void add(const Tally& t) {
    add(t.grains);
    add(t.walls);
    for (const ExactSum& sum : t.impulses.x) add(sum);
    for (const ExactSum& sum : t.impulses.y) add(sum);
    add(t.impulses.work);
    add(t.brakes);
    add(t.visits);
    add_all(t.ended_at_walls);
  }
  void add(const WallLattice& wall) {
    add_all(std::vector{wall.line, wall.radius, wall.motion.velocity, wall.motion.amplitude_x,
                        wall.motion.amplitude_y, wall.motion.frequency, wall.motion.phase});
    add(wall.count);
    add(wall.motion.start);
  }
  /// In the order of the slots.
  void add(const Grains& g) {
    for (const auto* vectors : {&g.position, &g.u, &g.kick}) add_all(*vectors);
    for (const auto* array : {&g.spin, &g.spin_kick}) add_all(*array);
    add(g.inertia);
    add_all(g.radius);
    add_all(g.mass);
    add_all(g.id);
  }
  void add(const State& state) {
    add_all(std::vector{state.box.width, state.box.length, state.gravity.x, state.gravity.y,
                        state.time_step, state.origin.energy, state.origin.momentum_y,
                        state.origin.moment_x});
    add(state.step);
    add_all(state.walls);
    add(state.grains);
    add_all(state.contacts);
    add_all(state.open_visits);
    add(state.tally);
  }
  const std::string& value() const { return bits_; }

private:
  std::string bits_;
};

/// Of a state or a part of one.
template <class Part>
std::string bits_of(const Part& part) {
  Bits bits;
  bits.add(part);
  return bits.value();
}

}  // namespace riesel
