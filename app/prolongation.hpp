// Going on with the runs of a sweep beyond their plan: for a longer time, or to a better precision.
//
// A point keeps its settings, except for those that may change when a run is resumed. How long it
// has become its result says; the last attempt's changes are in its record (io::RunRecord).
#pragma once

#include "app/sweep_directory.hpp"
#include "io/settings.hpp"
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
  /// `overrides` ("key=value") apply to the points of `sweep`, a directory, with these `names`; to
  /// all points if `names` is empty. Throws io::SettingsError for settings that may not change, and
  /// for values that they cannot have in the run of any point, as far as it has come; UnusableInput
  /// for sweeps whose runs cannot go on: those of a scenario without run.duration, and those that
  /// start from each other's ends.
  Prolongation(const io::Manifest& manifest, const std::filesystem::path& sweep,
               const std::vector<std::string>& names, const std::vector<std::string>& overrides);

  /// As app::standing_of(), except for a point that is done, but not as long as it is to be: it
  /// counts as interrupted, or as failed if it cannot go on or has failed in trying. A failure in
  /// trying other overrides than these does not count.
  RunStanding standing_of(const std::filesystem::path& point) const;

  /// As refresh() and note_misplaced(), with these standings; reduces the expected time of each
  /// point to what is left.
  void look_ahead(io::Manifest& manifest, const std::filesystem::path& sweep) const;

  /// The overrides for the run of a point. None while it has not reached a plan that is longer.
  std::vector<std::string> overrides_for(const std::filesystem::path& point) const;

  /// The simulated time that is left, relative to the planned one; of a point without a result, all
  /// of it.
  double part_left(const std::filesystem::path& point) const;

private:
  struct Goal {
    double planned;  // s, simulated, at most
    scenarios::RunLength wanted;
    std::vector<std::string> changes;  // overrides for the run
  };
  static Goal goal_for(const std::filesystem::path& point, const io::Settings& planned,
                       const std::vector<std::string>& overrides);
  const Goal* goal_of(const std::filesystem::path& point) const;

  std::map<std::string, Goal> goals_;  // by name of the point
};

}  // namespace riesel::app
