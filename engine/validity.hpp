// Whether the numbers of a run are physics of hard grains or an artefact of soft contacts.
//
// A soft-sphere calculation stands for hard grains as long as contacts are shallow, short, resolved
// by the time step and push the grains apart before they have passed through each other. Each of
// these is a finding with its own thresholds; the verdict is the worst of them. The thresholds and
// their reasons are in docs/validity-methods.md.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace riesel {

/// Ordered: later is worse.
enum class Validity {
  valid,      ///< no finding
  suspect,    ///< a finding that may change the result, or evidence that is missing
  unphysical  ///< a finding that makes the result an artefact
};

/// What the verdict rests on. Not a number stands for what is not known: that is suspect.
struct Evidence {
  double max_overlap_ratio;       ///< largest overlap over the radius of the smaller body
  double brake_failure_fraction;  ///< of the braking by walls, done by contacts cut short
  double passages_per_visit;      ///< contacts cut short per visit to a wall
  double wall_speed_ratio;        ///< mean slip speed at the beginning of wall contacts over v_crit
  double pulling_fraction;        ///< of the time of wall contacts, with F_N < 0
  double steps_per_contact;       ///< time steps of the shortest twentieth of contacts, at most
  double energy_error_ratio;      ///< see energy_error_ratio()
  double limits_exceeded;         ///< how many of the user's limits, which were to warn only
};

// Thresholds that are told elsewhere, too.
inline constexpr double suspect_overlap_ratio = 0.2;  ///< of Evidence::max_overlap_ratio
inline constexpr double unphysical_overlap_ratio = 0.5;
inline constexpr double unphysical_brake_failure = 0.5;  ///< of Evidence::brake_failure_fraction
inline constexpr double unphysical_energy_error = 0.1;   ///< of Evidence::energy_error_ratio

struct Finding {
  std::string_view name;
  double value;
  double suspect;     ///< threshold
  double unphysical;  ///< threshold; infinite (of either sign) if there is none
  bool low_is_bad;    ///< below the thresholds instead of above them
  Validity verdict;
  std::string_view meaning;  ///< in words, of a finding that is not valid
  std::string_view remedy;
};

struct ValidityVerdict {
  Validity verdict;
  std::vector<Finding> findings;  ///< all, in the order of Evidence

  /// By name; nullptr if there is none, as there may be in a verdict of another version.
  const Finding* find(std::string_view name) const;
  /// Not a number if there is no such finding.
  double value_of(std::string_view name) const;
};

ValidityVerdict judge(const Evidence& evidence);

/// The finding of this name, judged by its value alone; nothing if there is none.
std::optional<Finding> finding_named(std::string_view name, double value);

/// What single impacts can be judged by: the worst of these findings; of several the error of the
/// energy, or else the failure of the brake.
Finding judge_impacts(double max_overlap_ratio, double brake_failure_fraction,
                      double energy_error_ratio);

/// What a drop of a column of beads can be judged by: the worst of the overlap, the size of
/// detachment(), which is NaN for a drop that was given up, and the error of the energy.
Validity judge_drop(double max_overlap_ratio, double detachment, double energy_error_ratio);

/// Part of the energy that a column of rigid beads loses which one of soft beads keeps. By the
/// restitutions of both, as in engine/bead_column.hpp; 0 where rigid beads hardly lose any.
double detachment(double restitution, double rigid_restitution);

/// The verdict as it is written to files: "valid", "suspect", "unphysical".
std::string_view name(Validity validity);

/// That back again; nothing for a text that is none of them.
std::optional<Validity> validity_named(std::string_view text);

}  // namespace riesel
