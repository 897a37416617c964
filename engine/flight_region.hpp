// The flights of one slice: one thread's part of a step.
//
// A region steps the contacts of its slice and the grains of it that are deflected. A foreign grain
// in such a contact stands among them as a guest: its motion is taken from its own slice in each
// step, and what the contact does to it is told there (Border).
#pragma once

#include "engine/appointments.hpp"
#include "engine/border.hpp"
#include "engine/candidates.hpp"
#include "engine/close_watch.hpp"
#include "engine/contact_law.hpp"
#include "engine/courses.hpp"
#include "engine/deflected_grains.hpp"
#include "engine/skin_guard.hpp"
#include "engine/state.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

/// What the regions share.
struct Airspace {
  Airspace(State& the_state, const ContactModel& the_model, Candidates& the_candidates);

  State& state;
  const ContactModel& model;
  Candidates& candidates;
  Courses courses;
  std::vector<Announcement> announcements;  // one for each slice
  const double tolerance;                   ///< m, how far a deflected grain may be from its course
};

class alignas(cache_line) FlightRegion {
public:
  FlightRegion(Airspace& airspace, std::size_t index);
  FlightRegion(const FlightRegion&) = delete;
  FlightRegion& operator=(const FlightRegion&) = delete;
  ~FlightRegion() = default;

  /// To be called by all threads of a team, each for its region; see Flights.
  bool take_off(std::int64_t step);
  bool step(std::int64_t step);
  void land(std::int64_t step);

private:
  void begin(std::int64_t step, std::int64_t earliest);
  void take_up_contacts(std::int64_t step);
  void renew(std::int64_t step);
  void put_down(std::int64_t step);

  void move(std::int64_t step);
  void keep_appointments(std::int64_t step);
  void look_again(std::uint32_t pair, std::int64_t step, double reach, int strays);
  void look_at_pair(std::uint32_t pair, std::int64_t step);
  void look_at_near_wall(std::uint32_t near_wall, std::int64_t step);
  void step_contacts(std::int64_t step);
  void suffer(std::int64_t step);
  void correct_courses(std::int64_t step);
  void announce(std::int64_t step);
  void heed();

  void take_up(LiveContacts& contacts, std::size_t contact, std::int64_t step);
  DeflectedGrains::Place deflect(std::uint32_t slot, std::int64_t step);
  DeflectedGrains::Place invite(std::uint32_t slot);
  void let_go(std::int64_t body);
  void change_contacts(DeflectedGrains::Place place, std::int32_t by);
  void release(DeflectedGrains::Place place);
  void set_course(DeflectedGrains::Place place, std::int64_t step);

  bool is_guest(DeflectedGrains::Place place) const {
    return !border_.owns(deflected_.slot(place));
  }
  struct Position {
    Fixed x, y;
  };
  Position position(std::uint32_t slot, std::int64_t step) const;
  Position foreign_position(std::uint32_t slot, std::int64_t step) const;

  Airspace& airspace_;
  Slice& slice_;
  const std::size_t index_;
  StepUnits units_;
  const Fixed tolerance_x_, tolerance_y_;  // quanta, along each axis

  Border border_;
  DeflectedGrains deflected_;
  std::vector<DeflectedGrains::Place> guests_;
  std::vector<DeflectedGrains::Place> let_go_;  // of this step: a contact has ended
  SkinGuard skin_guard_;
  std::int64_t hold_until_ = 0;  // step until which the candidates of all slices hold for sure
  bool trouble_ = false;         // of any slice
  Appointments appointments_;
  CloseWatch close_watch_;
  bool under_way_ = false;  // they are made
};

}  // namespace riesel
