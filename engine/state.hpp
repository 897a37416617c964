// The state of a simulation: everything that the future depends on, and nothing else.
//
// Time is the number of steps done. At step n a grain has its position X(n); its displacement per
// step U, which is the leapfrog velocity w(n-1/2) dt seen from a frame that falls freely since step
// 0; and the kick K(n), the contact acceleration at step n times dt^2, which the next step adds to
// U. Hence
//
//   displacement in the step n-1 -> n   D = U + G n               G = gravity dt^2
//   velocity at step n                  v dt = U + G n + (G + K) / 2
//
// In free flight U does not change: a flying grain is three additions, and crossing several steps
// at once is exact. See docs/architecture.md for why these are integers.
//
// Where grains rotate the same holds for the spin: the angle per step S, which is the angular
// leapfrog velocity times dt, and the kick J that the next step adds to it. Nothing depends on the
// angle itself, as the grains are round; in free flight the spin does not change.
#pragma once

#include "engine/aligned.hpp"
#include "engine/box.hpp"
#include "engine/contact.hpp"
#include "engine/fixed_point.hpp"
#include "engine/tally.hpp"
#include "engine/wall_lattice.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace riesel {

/// The free grains, a structure of arrays. The slot (index) of a grain changes when the grains are
/// sorted, its id does not. Invariants: all arrays have the same size, except that the arrays of
/// spin are empty where grains do not rotate; ids are a permutation of 0 ... size-1, or, in a part
/// of a system (Part), a subset of the ids of the whole; radius and mass are positive.
struct Grains {
  AlignedVector<FixedVector> position;  ///< quanta of the box's axes
  AlignedVector<FixedVector> u;         ///< U: displacement per step in the falling frame, quanta
  AlignedVector<FixedVector> kick;      ///< K: contact acceleration of this step times dt^2, quanta
  AlignedVector<double> radius;         ///< m
  AlignedVector<double> mass;           ///< kg
  AlignedVector<std::int32_t> id;
  AlignedVector<Fixed> spin, spin_kick;  ///< S and J: positive from x towards y, quanta of angle
  double inertia = 0.0;  ///< moment of inertia over m r^2, the same for all; 0: no rotation

  std::size_t size() const { return position.size(); }
  bool rotate() const { return inertia > 0.0; }
  Fixed spin_of(std::size_t slot) const { return rotate() ? spin[slot] : 0; }
  Fixed spin_kick_of(std::size_t slot) const { return rotate() ? spin_kick[slot] : 0; }
  void resize(std::size_t n);
};

/// Calls visit(pointer to member) for each array of `g` whose values stepping changes.
template <class Visit>
void for_each_moving_array(const Grains& g, Visit visit) {
  for (auto member : {&Grains::position, &Grains::u, &Grains::kick}) visit(member);
  if (!g.rotate()) return;
  for (auto member : {&Grains::spin, &Grains::spin_kick}) visit(member);
}
/// Likewise for the arrays whose values stepping leaves alone (but for their order).
template <class Visit>
void for_each_lasting_array(Visit visit) {
  for (auto member : {&Grains::radius, &Grains::mass}) visit(member);
  visit(&Grains::id);
}

/// Calls visit(array) for each array of the grains, const or not; those of spin only if they
/// rotate.
template <class AnyGrains, class Visit>
void for_each_array_of(AnyGrains& g, Visit visit) {
  const auto visit_member = [&](auto member) { visit(g.*member); };
  for_each_moving_array(g, visit_member);
  for_each_lasting_array(visit_member);
}

/// What the system had at step 0: the balances of energy and momentum are measured from there.
struct Origin {
  double energy = 0.0;      ///< J, kinetic, of rotation, and elastic of contacts of an earlier run
  double momentum_y = 0.0;  ///< kg m/s along y, with the whole of the kicks of step 0
  double moment_x = 0.0;    ///< kg m, sum of mass times x
};

/// m/s^2. Along +y, the axis of the tube, where it stands upright.
struct Gravity {
  double x = 0.0, y = 0.0;
};

struct State {
  Box box{};
  std::vector<WallLattice> walls;  ///< in the order of x: of two, the first is the left one
  Gravity gravity;
  double time_step = 0.0;  ///< s
  std::int64_t step = 0;   ///< steps done
  Grains grains;
  std::vector<Contact> contacts;       ///< the present ones, ordered by (wall, grain, partner)
  std::vector<WallVisit> open_visits;  ///< visits that may go on, ordered by (wall, grain, begin)
  Tally tally;                         ///< what the ended contacts did since step 0
  Origin origin;                       ///< set by the Simulation that does the first step

  double time() const { return static_cast<double>(step) * time_step; }  ///< s
  const WallLattice& wall(std::int32_t index) const {
    return walls[static_cast<std::size_t>(index)];
  }
};

/// Quanta per step^2, what free fall adds to the displacement per step in each step: gravity times
/// dt^2, the G of the formulae above.
FixedVector fall_per_step(const State& state);

/// One grain in SI units, for adding grains to a state and for reading them.
struct Grain {
  double x, y;    ///< m
  double vx, vy;  ///< m/s
  double radius;  ///< m
  double mass;    ///< kg
  double spin =
      0.0;  ///< rad/s, positive from x towards y; without meaning where grains do not rotate
};

/// Adds a grain without contacts or kick; its id is the number of grains before it. At step 0 only.
/// The box, the gravity, the time step and the inertia of the state must have been set. Throws
/// std::invalid_argument for a grain 4 widths from x = 0 or farther, or one that would move by 4
/// widths or half of the length in a step, or make half a turn.
void add_grain(State& state, const Grain& grain);

/// The grains of a state in SI units; cheaper than grain_at() for many grains. Keeps a reference to
/// the grains: the state must outlive it, and must not be stepped meanwhile.
class GrainView {
public:
  explicit GrainView(const State& state);
  /// The grain in `slot`, y in [0, length).
  Grain operator[](std::size_t slot) const {
    const Grains& g = *grains_;
    return {
        .x = box_.metres_x(g.position[slot].x),
        .y = box_.place_y(g.position[slot].y),
        .vx = velocity(g.u[slot].x, fallen_.x, g.kick[slot].x, fall_.x) * to_vx_,
        .vy = velocity(g.u[slot].y, fallen_.y, g.kick[slot].y, fall_.y) * to_vy_,
        .radius = g.radius[slot],
        .mass = g.mass[slot],
        .spin =
            (static_cast<double>(g.spin_of(slot)) + 0.5 * static_cast<double>(g.spin_kick_of(slot)))
            * to_spin_,
    };
  }

private:
  /// Quanta per step, at the full step: U + G n + (K + G) / 2, see the top of this file.
  static double velocity(Fixed u, Fixed fallen, Fixed kick, Fixed fall) {
    return static_cast<double>(wrapped_sum(u, fallen))
           + 0.5 * static_cast<double>(wrapped_sum(kick, fall));
  }

  const Grains* grains_;
  Box box_;
  FixedVector fall_, fallen_;  // quanta per step: G, and G times the steps done
  double to_vx_, to_vy_;       // m/s per quantum per step
  double to_spin_;             // rad/s per quantum per step
};

/// slots[id] is the slot of the grain with this id; 0 for ids, below the largest, that no grain
/// has.
std::vector<std::size_t> slots_by_id(const Grains& grains);

/// The grain in `slot`, as GrainView gives it.
Grain grain_at(const State& state, std::size_t slot);

/// m; the same bits for any order of the slots. NaN without grains.
double mean_diameter(const Grains& grains);
/// kg; the same bits for any order of the slots.
double total_mass(const Grains& grains);
/// kg
double mean_mass(const Grains& grains);

/// A point of time, for messages: "at t = 0.0125 s (step 1234)".
std::string when(std::int64_t step, double time_step);
inline std::string when(const State& state) { return when(state.step, state.time_step); }

/// 64-bit FNV-1a hash of all that the future depends on and of the tally so far, the same for any
/// order of the slots. Of the tally it leaves out the impulse of each single wall and which contact
/// was the deepest.
std::uint64_t state_hash(const State& state);

}  // namespace riesel
