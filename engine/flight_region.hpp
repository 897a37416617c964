// The flights of one slice, and the parts of a step.
//
// A region steps the contacts of its slice and the deflected grains of the slice. If the second
// grain of such a contact is foreign (of another slice), a copy of it stands among the deflected
// grains as a guest: its motion is read from its own slice in each step, and what the contact does
// to it is reported there (Border).
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

/// How far grains may be from where they are expected. Constant until the candidates are listed
/// again.
struct Leeway {
  double tolerance;  ///< m, of a deflected grain from its course
  Fixed x, y;        ///< quanta, the tolerance along each axis
  double room;       ///< m, how far courses may lead within the skin (room_in_skin())
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
  const double shaking;                     ///< m per step, largest speed of an oscillating wall

  /// For grains as fast as they were when the candidates were listed.
  Leeway leeway() const;
};

class alignas(cache_line) FlightRegion {
public:
  /// For slice number `index`. Keeps references. Adds the time that steps take to `profile`.
  FlightRegion(Airspace& airspace, std::size_t index, Profile& profile);
  FlightRegion(const FlightRegion&) = delete;
  FlightRegion& operator=(const FlightRegion&) = delete;
  ~FlightRegion() = default;

  // Each of these functions is to be called for all regions, by the thread that has the slice.
  // Where threads, or slices that go askew, must wait for each other in between, is in flights.cpp.

  // After the candidates have been listed at `step`, when all grains are at this step, these four
  // are called in this order:

  /// Forgets all about the former candidates. `leeway` must be the same for all regions.
  void start_over(std::int64_t step, const Leeway& leeway);
  /// Takes up the deflected grains: those of contacts, and those with a kick.
  void take_up_contacts(std::int64_t step);
  /// Whether the last kicks are in the velocities already, as in the middle of a step, when all
  /// grains have moved, or are to be added by the next step.
  enum class Kicks { taken_up, to_come };
  /// Gives the deflected grains their courses, and announces.
  void set_out(std::int64_t step, Kicks kicks);
  /// Makes the appointments of all candidates: none before `earliest`, none after `hold_until`.
  void make_all_appointments(std::int64_t step, std::int64_t earliest, std::int64_t hold_until);

  /// Goes on from `step`, at which all grains have landed and which is the origin of courses now.
  void set_out_again(std::int64_t step);

  // A step, to step number `step`, is move(), collide(), settle() and foresee().

  /// Moves the deflected grains. (Guests get their motion from their slices in collide().)
  void move(std::int64_t step);
  /// Looks at the candidates that are due, and computes the kicks of contacts.
  void collide(std::int64_t step);
  /// Takes up kicks by other slices, and gives new courses where needed.
  void settle(std::int64_t step);
  /// Makes appointments according to the new courses, none for after `hold_until`.
  void foresee(std::int64_t step, std::int64_t hold_until);

  /// The parts of settle() and foresee() that do not depend on other slices, for the time of
  /// waiting for them; optional, as settle() and foresee() do the rest. Grains that have been let
  /// go and are foreign to no other slice fly on, and guests without contacts leave; candidates
  /// without a foreign grain get their appointments.
  void settle_inside(std::int64_t step);
  void foresee_inside(std::int64_t step, std::int64_t hold_until);

  /// Loads what steps need of the slice into the caches.
  void fetch() const;

  /// Replaces the courses in the store by the motion of the grains at `step`, as a State has it.
  void land(std::int64_t step);

  /// From now on a grain is a stray if the candidates do not hold for it until `step`. With
  /// nobody_asks there are no strays: the steps are done together, and hold_until is obeyed.
  static constexpr std::int64_t nobody_asks = INT64_MIN;
  void need_candidates_until(std::int64_t step);
  /// To be called after collide() while slices are askew: ends the run if a stray has come so close
  /// to a body that is no candidate, or has gone so far, that a contact may be missed.
  void watch_strays(std::int64_t step);

private:
  void keep_appointments(std::int64_t step);
  void look_again(std::uint32_t pair, std::int64_t step, double reach, int deflected);
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
  Selection let_go_;  // places of grains of which a contact has ended in this step
  SkinGuard skin_guard_;
  std::int64_t needed_until_ = nobody_asks;  // see need_candidates_until()
  Appointments appointments_;
  Profile& profile_;
};

}  // namespace riesel
