// Stepping at the cost of the contacts, not of the grains.
//
// In rapid flow nearly all grains are in free flight, which the integer kinematics crosses exactly
// in any number of steps at once. So only the grains that take part in a contact are stepped. The
// others stand in the store with the step of their last touch, and each candidate (a pair, or a
// grain near a wall) has an appointment: the step before which it cannot touch as long as the
// grains keep to their courses. In that step it is looked at, and either a contact begins or a new
// appointment is made.
//
// A grain in contact leaves its course. Appointments with it are made with a tolerance: they hold
// as long as it stays that close to the course; when it does not, or when its last contact ends, it
// gets a new course and new appointments. So no contact is missed, and the steps done here are the
// same, bit by bit, as those of plain stepping. See docs/performance.md for the figures and
// docs/architecture.md for how this compares with fixed windows.
#pragma once

#include "engine/calendar.hpp"
#include "engine/candidates.hpp"
#include "engine/contact_law.hpp"
#include "engine/state.hpp"

#include <cstdint>
#include <vector>

namespace riesel {

class Flights {
public:
  /// All grains of `state` must be at its step. One slice only. Keeps references.
  Flights(State& state, const ContactModel& model, Candidates& candidates);

  /// One step of all that does not fly.
  void step(std::int64_t step);

  /// Brings all grains to this step, which must be that of the last step().
  void land_all(std::int64_t step);

private:
  /// A grain that is stepped: how far it is from the course for which its appointments were made.
  struct Deflected {
    std::uint32_t slot;
    std::int32_t contacts;  // that last
    bool fresh;             // its appointments are not yet made for this course
    Fixed x, y, ux, uy;     // actual minus course
  };
  /// The straight path (in the falling frame) that a grain is expected to follow, now.
  struct Course {
    Fixed x, y, ux, uy;
    double tolerance;  // m
  };

  void begin(std::int64_t step, std::int64_t earliest);
  void link();
  void move_deflected(std::int64_t step);
  void keep_appointments(std::int64_t step);
  void note_contacts();
  void correct_courses(std::int64_t step);

  void make_appointment(std::uint32_t candidate, std::int64_t now, std::int64_t earliest);
  double free_steps_of_pair(std::uint32_t pair, std::int64_t now) const;
  double free_steps_at_wall(const NearWall& near, std::int64_t now) const;

  Course course(std::uint32_t slot, std::int64_t now) const;
  Fixed flight_x(std::uint32_t slot, std::int64_t step) const;
  Fixed flight_y(std::uint32_t slot, std::int64_t step) const;
  void bring_to(std::uint32_t slot, std::int64_t step);
  bool strays(const Deflected& deflected) const;
  Deflected on_new_course(std::uint32_t slot, std::int32_t contacts) const;
  Deflected& deflect(std::uint32_t slot);
  void take_up(std::uint32_t candidate);
  void let_go(std::uint32_t candidate);
  template <class Visit>
  void for_each_grain_of(std::uint32_t candidate, Visit visit) const;

  State& state_;
  const ContactModel& model_;
  Candidates& candidates_;
  Slice& slice_;
  const Fixed fall_;
  const double tolerance_;                 // m
  const Fixed tolerance_x_, tolerance_y_;  // quanta, along each axis

  std::vector<std::int64_t> since_;         // step of the position in the store, by slot
  std::vector<std::int32_t> deflected_at_;  // place in deflected_, or `flying`, by slot
  std::vector<Deflected> deflected_;
  std::vector<std::uint32_t> changed_;  // slots with a new course

  // Candidates are numbered: the pairs first, then the grains near walls.
  Calendar calendar_;
  std::vector<std::int64_t> due_;                  // step of the appointment, by candidate
  std::vector<std::uint32_t> first_link_, links_;  // the candidates of each slot
  std::vector<std::uint32_t> touching_;            // candidates in contact, ordered
  std::vector<std::uint32_t> looked_at_;           // in this step, ordered
  std::vector<std::uint32_t> still_touching_;      // after it, ordered
  std::vector<std::uint32_t> loose_;               // looked at and not in contact
};

}  // namespace riesel
