// The flights of one slice, and the parts of a step.
//
// A region steps the contacts of its slice and the grains of it that are deflected. A foreign grain
// in such a contact stands among them as a guest: its motion is taken from its own slice in each
// step, and what the contact does to it is told there (Border).
#pragma once

#include "engine/appointments.hpp"
#include "engine/border.hpp"
#include "engine/candidates.hpp"
#include "engine/contact_law.hpp"
#include "engine/courses.hpp"
#include "engine/deflected_grains.hpp"
#include "engine/profile.hpp"
#include "engine/selection.hpp"
#include "engine/skin_guard.hpp"
#include "engine/state.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

/// How far grains may be from where they are expected, until the candidates are listed again.
struct Leeway {
  double tolerance;  ///< m, of a deflected grain from its course
  Fixed x, y;        ///< quanta, of it along each axis
  double room;       ///< m, that grains have in the skin on their courses
};

/// What the regions share.
struct Airspace {
  Airspace(State& the_state, const ContactModel& the_model, Candidates& the_candidates);

  State& state;
  const ContactModel& model;
  Candidates& candidates;
  Courses courses;
  std::vector<Announcement> announcements;  // one for each slice
  const double diameter;                    ///< m, mean
  const double shaking;                     ///< m per step, of the wall that shakes fastest

  /// For grains as fast as they were when the candidates were listed.
  Leeway leeway() const;
};

class alignas(cache_line) FlightRegion {
public:
  /// Keeps references. The time that a step takes is noted in `profile`.
  FlightRegion(Airspace& airspace, std::size_t index, Profile& profile);
  FlightRegion(const FlightRegion&) = delete;
  FlightRegion& operator=(const FlightRegion&) = delete;
  ~FlightRegion() = default;

  // Each of these is to be called for all regions, by the thread that has the slice. Where the
  // threads wait for each other in between, flights.cpp says, and what slices wait for that are
  // askew.

  /// The candidates have just been listed, at `step`, that of all grains. `leeway` is the same for
  /// all regions.
  void start_over(std::int64_t step, const Leeway& leeway);
  void take_up_contacts(std::int64_t step);
  /// The last kicks: in the velocities already, as in the middle of a step, when all have moved, or
  /// to be taken up by the next step.
  enum class Kicks { taken_up, to_come };
  void set_out(std::int64_t step, Kicks kicks);
  void make_all_appointments(std::int64_t step, std::int64_t earliest, std::int64_t hold_until);

  /// All grains have landed at `step`, the origin of courses, and go on from there.
  void set_out_again(std::int64_t step);

  /// One step, to this one, of all that does not fly. First everything but guests moves on;
  void move(std::int64_t step);
  /// then what is due is looked at, and contacts give their kicks;
  void collide(std::int64_t step);
  /// kicks of other slices come in, and courses change;
  void settle(std::int64_t step);
  /// appointments are made with the new courses, none for after `hold_until`.
  void foresee(std::int64_t step, std::int64_t hold_until);

  /// What can be done of these two before, while others are waited for, or left to them: grains
  /// that are foreign to none and have been let go, or have been guests, fly on; candidates that
  /// have no foreign grain get their appointments.
  void settle_inside(std::int64_t step);
  void foresee_inside(std::int64_t step, std::int64_t hold_until);

  /// Brings what steps need of the slice from memory into the caches.
  void fetch() const;

  /// The store becomes the state of `step`: the courses of deflected grains are given up for their
  /// motion.
  void land(std::int64_t step);

  /// From now on a grain is a stray for which the candidates do not hold until this step. If nobody
  /// asks for that, somebody else watches how long they hold.
  static constexpr std::int64_t nobody_asks = INT64_MIN;
  void need_candidates_until(std::int64_t step);
  /// To be called after collide() while candidates are needed: ends the run if a stray has gone to
  /// where nobody looks for it.
  void watch_strays(std::int64_t step);

private:
  void keep_appointments(std::int64_t step);
  void look_again(std::uint32_t pair, std::int64_t step, double reach, int strays);
  void look_at_pair(std::uint32_t pair, std::int64_t step);
  void look_at_near_wall(std::uint32_t near_wall, std::int64_t step);
  void step_contacts(std::int64_t step);
  void suffer(std::int64_t step);
  void let_fly(DeflectedGrains::Place place, std::int64_t step);
  void correct_courses(std::int64_t step);
  void announce(std::int64_t step);
  void lose(const Stray& stray, std::int64_t step);
  void look_around(const Stray& stray, SlotRange among, std::int64_t step);
  void look_at_walls(const Stray& stray, std::int64_t step);

  void take_up(LiveContacts& contacts, std::size_t contact, std::int64_t step);
  DeflectedGrains::Place deflect(std::uint32_t slot, std::int64_t step);
  DeflectedGrains::Place invite(std::uint32_t slot);
  void let_go(std::int64_t body);
  void change_contacts(DeflectedGrains::Place place, std::int32_t by);
  void release(DeflectedGrains::Place place);
  void set_course(DeflectedGrains::Place place, std::int64_t step, Kicks kick = Kicks::to_come);

  bool is_guest(DeflectedGrains::Place place) const {
    return !border_.owns(deflected_.slot(place));
  }
  bool at_border(DeflectedGrains::Place place) const {
    return border_.is_at_border(deflected_.slot(place));
  }
  FixedVector position(std::uint32_t slot, std::int64_t step) const;

  Airspace& airspace_;
  Slice& slice_;
  StepUnits units_;
  Leeway leeway_{};

  Border border_;
  DeflectedGrains deflected_;
  std::vector<DeflectedGrains::Place> guests_;
  Selection let_go_;  // places, of this step: a contact has ended
  SkinGuard skin_guard_;
  std::int64_t needed_until_ = nobody_asks;  // step, the candidates
  Appointments appointments_;
  Profile& profile_;
};

}  // namespace riesel
