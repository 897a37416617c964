// Going on with the runs of a sweep beyond what was planned for them: further, or to a better
// precision.
//
// A point remains what it is, the run of its settings; only how far it is followed changes, and
// what else may change when a run is resumed. So what it comes to is, bit by bit, what it would
// have come to if it had been planned like this. Nothing is noted anywhere: whether a point has
// been prolonged is seen from the settings that its run has left beside its results.
#pragma once

#include "app/sweep_directory.hpp"
#include "io/sweep_manifest.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace riesel::app {

class Prolongation {
public:
  /// Nothing goes on.
  Prolongation() = default;
  /// `overrides` ("key=value") are for all runs of `sweep`, a directory. Throws SettingsError
  /// for settings that may not change or have no such value, UnusableInput for runs that cannot go
  /// on: those that have no length, and those that others have started from.
  Prolongation(const io::Manifest& manifest, const std::filesystem::path& sweep,
               std::vector<std::string> overrides);

  /// Brings the snapshot in the manifest up to date, as refresh(): what is to go on counts as
  /// interrupted, and is expected to take as long as is left of it.
  void refresh(io::Manifest& manifest, const std::filesystem::path& sweep) const;

  /// As standing_of(); a point that is to go on counts as interrupted.
  RunStanding standing_of(const std::filesystem::path& point) const;

  struct Way {
    /// That the run is to be called with. None if it is planned to go further than they say, or has
    /// gone further.
    std::vector<std::string> overrides;
    bool is_new;  ///< they change its settings
    /// What is to be done of a point that is done or was not begun, as a part of what was planned.
    double part;
  };
  Way way_of(const std::filesystem::path& point) const;

private:
  std::vector<std::string> overrides_;
};

}  // namespace riesel::app
