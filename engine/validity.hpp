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

/// What the verdict rests on. NaN means not known, and counts as suspect.
struct Evidence {
  double max_overlap_ratio;       ///< largest overlap over the radius of the smallest body
  double brake_failure_fraction;  ///< of the braking by walls, done by contacts cut short
  double passages_per_visit;      ///< contacts cut short per visit to a wall
  double wall_speed_ratio;        ///< mean slip speed at the beginning of wall contacts over v_crit
  double pulling_fraction;        ///< part of the time of wall contacts with F_N < 0
  double steps_per_contact;       ///< 5 % quantile, which may be low by a fifth
  double energy_error_ratio;      ///< see energy_error_ratio()
  double limits_exceeded;         ///< number of exceeded user limits of the kind that only warns
  double contact_rate_times_t_col;  ///< contacts with other grains that begin per grain and t_col
};

// Thresholds that are also shown elsewhere.
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
  std::string_view meaning;  ///< what it means if it is not valid, in words
  std::string_view remedy;
};

struct ValidityVerdict {
  Validity verdict;
  std::vector<Finding> findings;  ///< all, in the order of Evidence

  /// The finding of this name; nullptr if there is none, as in a verdict by another version.
  const Finding* find(std::string_view name) const;
  /// The value of the finding of this name; NaN if there is none.
  double value_of(std::string_view name) const;
};

/// All findings, and the worst of their verdicts.
ValidityVerdict judge(const Evidence& evidence);

/// The finding of this name, judged by its value alone; nothing if there is none.
std::optional<Finding> finding_named(std::string_view name, double value);

/// The verdict on single impacts: the worst of these three findings; of equally bad ones that on
/// the error of the energy comes first, then that on the failure of the brake.
Finding judge_impacts(double max_overlap_ratio, double brake_failure_fraction,
                      double energy_error_ratio);

/// The verdict on a drop of a column of beads: the worst of those on the overlap, on the size of
/// detachment() (NaN for a drop that was given up) and on the error of the energy.
Validity judge_drop(double max_overlap_ratio, double detachment, double energy_error_ratio);

/// Of the energy that a column of rigid beads loses, the part that one of soft beads keeps. Follows
/// from the restitutions of the columns (ColumnResult, RigidColumn); 0 where rigid beads lose
/// hardly any energy.
double detachment(double restitution, double rigid_restitution);

/// The verdict as it is written to files: "valid", "suspect", "unphysical".
std::string_view name(Validity validity);

/// The inverse of name(Validity); nothing for any other text.
std::optional<Validity> validity_named(std::string_view text);

}  // namespace riesel
