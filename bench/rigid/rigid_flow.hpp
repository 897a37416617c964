// The tube with rigid grains, from one impact to the next: what the soft grains of the engine tend
// to as they get stiffer, and the most that could be saved on them, as no impact takes any steps.
//
// The model is that of the engine without its stiffness: discs that do not turn, e_N, Coulomb
// friction (impact_rule.hpp), corrugated walls, gravity along the tube. Nothing here is the
// engine's: doubles, a tournament of events, cells, Newton's method for the walls. So it is also an
// independent check of the engine's stiffest flows.
//
// Rigid grains that lose energy may meet infinitely often within a finite time. As grains that
// touch for a moment do not lose it while they have not parted, an impact has e_N = 1, and friction
// as ever, if one of the two has had another one less than `shortest_interval` ago: Luding and
// McNamara, Granular Matter 1, 113 (1998).
#pragma once

#include "bench/rigid/impact_rule.hpp"
#include "bench/rigid/tournament.hpp"
#include "engine/contact_law.hpp"
#include "engine/state.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace riesel::bench {

/// Cumulative.
struct RigidCounts {
  std::int64_t impacts = 0;       ///< between grains
  std::int64_t wall_impacts = 0;  ///< of a grain with a wall grain
  std::int64_t elastic = 0;       ///< of all these, those that were made so
  double wall_impulse_y = 0.0;    ///< kg m/s, given to the grains by the walls
};

/// s, usually the shortest time between two impacts of a grain that lose energy.
inline constexpr double usual_interval = 1e-7;

class RigidFlow {
public:
  /// The grains of `state`. Throws std::invalid_argument where there is more to it than this
  /// program knows: other laws than the linear one with capped slip, rotation, smooth or moving
  /// walls, gravity across the tube, or a box less than three grains wide or long.
  RigidFlow(const State& state, const ContactModel& model, double shortest_interval);

  /// By `duration` (s), some milliseconds: for so long the grains are seen from a frame that falls
  /// as they do.
  void advance(double duration);

  std::size_t size() const { return discs_.size(); }
  /// SI units, y in [0, length).
  Grain grain(std::size_t i) const;
  const RigidCounts& counts() const { return counts_; }

private:
  static constexpr std::size_t nobody = SIZE_MAX;

  struct Wall {
    double line, radius, spacing;  // m
  };
  struct WallEvent {
    double time;   // s from now
    bool touches;  // or it is time to look again
    double x, y;   // m, from the disc to the wall grain
  };
  struct Disc {
    double x, y, ux, uy;  // m and m/s in the falling frame, at the time `since`
    double since;
    double radius, mass;
    double last_impact;
    std::int64_t column, row;    // of its cell; rows go on beyond the period
    std::size_t next, previous;  // in its cell
    // What comes next, as was foreseen: a meeting (with a disc that has had so many impacts), a
    // touch of a wall grain, or neither.
    std::size_t partner;
    std::uint64_t impacts, partners_impacts;
    WallEvent wall;
  };

  void enter_frame();
  void leave_frame(double duration);
  void take_place(std::size_t i);
  void leave_place(std::size_t i);
  std::size_t cell_of(const Disc& disc) const;

  void come_to_now(Disc& disc) const;
  void happen(std::size_t i);
  void change_cell(std::size_t i);
  void meet(std::size_t i, std::size_t j);
  void touch_wall(std::size_t i);
  ImpactRule rule_for(const Disc& disc, double last_impact, double reduced_mass);

  void foresee(std::size_t i);
  double leaves_cell(const Disc& disc) const;
  double meets(const Disc& disc, const Disc& other, std::int64_t row) const;
  std::optional<WallEvent> meets_wall(const Disc& disc, const Wall& wall, double within) const;

  Box box_;
  double gravity_, mu_, shortest_interval_;
  LinearLaw law_;
  Attraction attraction_;
  std::vector<Wall> walls_;
  std::vector<Disc> discs_;
  Tournament next_;
  RigidCounts counts_;

  double frame_velocity_ = 0.0;   // at the beginning of an advance
  double now_ = 0.0, end_ = 0.0;  // s since then
  double cell_x_, cell_y_;
  std::int64_t columns_, rows_;
  std::vector<std::size_t> first_in_cell_;
};

}  // namespace riesel::bench
