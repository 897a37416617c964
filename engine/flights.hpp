// Stepping at the cost of the contacts, not of the grains.
//
// In rapid flow nearly all grains are in free flight, which the integer kinematics crosses exactly
// in any number of steps at once. So only the grains that take part in a contact are stepped. The
// others stand in the store with the step of their last touch, and each candidate (a pair, or a
// grain near a wall) has an appointment: the step before which it cannot touch as long as the
// grains keep to their courses. In that step it is looked at, and either a contact begins or a new
// appointment is made.
//
// A grain in contact leaves its course. Most appointments are made with a tolerance: they hold as
// long as both grains stay that close to their courses, in contact or not. Those of pairs that are
// too close for that are exact, and made anew when one of the two is deflected. A grain that goes
// beyond the tolerance, or whose last contact ends, gets a new course and new appointments. So no
// contact is missed, and the steps done here are the same, bit by bit, as those of plain stepping.
// See docs/performance.md for the figures and docs/architecture.md for how this compares with fixed
// windows.
#pragma once

#include "engine/appointments.hpp"
#include "engine/candidates.hpp"
#include "engine/contact_law.hpp"
#include "engine/courses.hpp"
#include "engine/deflected_grains.hpp"
#include "engine/skin_guard.hpp"
#include "engine/state.hpp"

#include <cstdint>
#include <vector>

namespace riesel {

class Flights {
public:
  /// A skin that serves flights, as a part of the mean diameter: pairs far apart cost no more than
  /// an appointment.
  static constexpr double skin_per_diameter = 0.6;

  /// One slice only; nobody else uses the candidates afterwards. Keeps references.
  Flights(State& state, const ContactModel& model, Candidates& candidates);

  /// To be called before the first step(), and between land() and the next. All grains are at the
  /// step of the state. From here to land() the store is no state.
  void take_off();
  /// One step of all that does not fly.
  void step(std::int64_t step);
  /// Brings all grains to this step, which must be that of the last step().
  void land(std::int64_t step);

private:
  void begin(std::int64_t step, std::int64_t earliest);
  void renew(std::int64_t step);

  void keep_appointments(std::int64_t step);
  void look_at_pair(std::uint32_t pair, std::int64_t step);
  void look_at_near_wall(std::uint32_t near_wall, std::int64_t step);
  void step_contacts();
  void correct_courses(std::int64_t step);

  void take_up(LiveContacts& contacts, std::size_t contact, std::int64_t step);
  DeflectedGrains::Place deflect(std::uint32_t slot, std::int64_t step);
  void let_go(std::int64_t place);
  void set_course(DeflectedGrains::Place place, std::int64_t step);

  Fixed x(std::uint32_t slot, std::int64_t step) const;
  Fixed y(std::uint32_t slot, std::int64_t step) const;
  Motion motion(std::uint32_t slot, std::int64_t step) const;

  State& state_;
  const ContactModel& model_;
  Candidates& candidates_;
  Slice& slice_;
  StepUnits units_;
  const double tolerance_;                 // m
  const Fixed tolerance_x_, tolerance_y_;  // quanta, along each axis

  Courses courses_;
  DeflectedGrains deflected_;
  std::vector<DeflectedGrains::Place> let_go_;  // of this step: a contact has ended
  SkinGuard skin_guard_;
  std::int64_t hold_until_ = 0;  // step until which the candidates hold for sure
  Appointments appointments_;
  bool under_way_ = false;  // they are made
};

}  // namespace riesel
