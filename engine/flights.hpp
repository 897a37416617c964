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

#include "engine/calendar.hpp"
#include "engine/candidates.hpp"
#include "engine/contact_law.hpp"
#include "engine/deflected_grains.hpp"
#include "engine/free_flight.hpp"
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
  void link();
  void renew(std::int64_t step);
  std::int64_t first_to_leave_skin() const;
  double room_in_skin() const;
  std::int64_t leaves_skin(std::uint32_t slot, std::int64_t now) const;

  void keep_appointments(std::int64_t step);
  void look_at_pair(std::uint32_t pair);
  void look_at_wall(std::uint32_t near_wall);
  void step_contacts();
  void correct_courses(std::int64_t step);

  void take_up(LiveContacts& contacts, std::size_t contact, std::int64_t step);
  DeflectedGrains::Place deflect(std::uint32_t slot, std::int64_t step);
  void let_go(std::int64_t place);
  void set_course(DeflectedGrains::Place place, std::int64_t step);
  void reconsider(std::uint32_t candidate);
  template <class Visit>
  void for_each_candidate_of(std::uint32_t slot, Visit visit) const;
  void make_appointments(std::int64_t now, std::int64_t earliest);
  void enter(std::uint32_t candidate, std::int64_t free_steps, std::int64_t now,
             std::int64_t earliest);
  double free_steps_at_wall(const NearWall& near, std::int64_t now) const;

  Courses courses() const;
  Fixed course_x(std::uint32_t slot, std::int64_t step) const;
  Fixed course_y(std::uint32_t slot, std::int64_t step) const;
  std::int32_t since_sorted(std::int64_t step) const {
    return static_cast<std::int32_t>(step - sorted_at_);
  }
  Fixed x_now(std::uint32_t slot) const;
  Fixed y_now(std::uint32_t slot) const;
  Motion motion(std::uint32_t slot, std::int64_t step) const;
  void put_down(std::uint32_t slot, const Motion& motion, std::int64_t step);

  State& state_;
  const ContactModel& model_;
  Candidates& candidates_;
  Slice& slice_;
  StepUnits units_;
  const double tolerance_;                 // m
  const Fixed tolerance_x_, tolerance_y_;  // quanta, along each axis

  DeflectedGrains deflected_;
  std::vector<std::int32_t> place_;             // in deflected_, or `flying`, by slot
  AlignedVector<double> stray_;                 // m, how far off its course a grain may be, by slot
  AlignedVector<std::int64_t> since_;           // step of the course in the store, by slot
  std::int64_t sorted_at_ = 0;                  // step of that
  std::int64_t hold_until_ = 0;                 // step until which the candidates hold for sure
  std::vector<DeflectedGrains::Place> let_go_;  // of this step: a contact has ended

  // Candidates are numbered: the pairs first, then the grains near walls.
  Calendar calendar_;
  std::vector<std::int32_t> due_;    // of the appointment, since_sorted(), or `never`
  std::vector<std::uint8_t> exact_;  // appointments without tolerance
  // The candidates of a slot: pairs from first_pair_ on, and links_ from first_link_ on.
  std::vector<std::uint32_t> first_pair_, first_link_, links_;
  std::vector<std::uint32_t> pairs_, walls_;  // that need a new appointment
  Forecast forecast_;
};

}  // namespace riesel
