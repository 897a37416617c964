// Going on with the runs of a sweep beyond what was planned for them: further, or to a better
// precision.
//
// A point remains what it is, the run of its settings; only how far it is followed changes, and
// what else may change when a run is resumed. Nothing is noted anywhere: whether a point has been
// prolonged is seen from what its result says of its length.
#pragma once

#include "app/sweep_directory.hpp"
#include "io/sweep_manifest.hpp"
#include "scenarios/run_length.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace riesel::app {

class Prolongation {
public:
  /// Nothing goes on.
  Prolongation() = default;
  /// `overrides` ("key=value") are for those points of `sweep`, a directory, that have these
  /// `names`; all if there are none. Throws SettingsError for settings that may not change or have
  /// no such value, UnusableInput for runs that cannot go on: those that have no length, and those
  /// that others have started from.
  Prolongation(const io::Manifest& manifest, const std::filesystem::path& sweep,
               const std::vector<std::string>& names, std::vector<std::string> overrides);

  /// As standing_of(); a point that is done, but not as far as it is to go, counts as interrupted,
  /// or as failed if it cannot go on or has failed to.
  RunStanding standing_of(const std::filesystem::path& point) const;

  /// As refresh(), with those; points are expected to take as long as is left of them.
  void look_ahead(io::Manifest& manifest, const std::filesystem::path& sweep) const;

  /// What the run of a point is to be called with. None if it is planned to go further.
  std::vector<std::string> overrides_for(const std::filesystem::path& point) const;

  /// What is left to be done of a point that is done, or all of another, as a part of what was
  /// planned.
  double part_left(const std::filesystem::path& point) const;

private:
  struct Goal {
    double planned;  // s, simulated, at most
    scenarios::RunLength wanted;
  };
  const Goal* goal_of(const std::filesystem::path& point) const;

  std::vector<std::string> overrides_;
  std::map<std::string, Goal> goals_;  // by name of the point
};

}  // namespace riesel::app
