// The states from which is measured: made on first use, then kept as checkpoints.
//
// A state of the flow is what the engine itself comes to from a fresh packing of some 1,400 grains.
// Longer tubes are copies of it along y. Copies would do the same at the same moment, so each grain
// gets a velocity of its own besides, a tenth of the thermal one, and all are stepped for a while:
// the bursts of contacts then no longer coincide. The width, and with it the profile across the
// tube, is that of the short one.
#pragma once

#include "bench/cases.hpp"
#include "engine/state.hpp"
#include "io/settings.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace riesel::bench {

/// The settings of a case in a size: of a tube that is so many times as long, with the wall grains
/// where they were. `overrides` change settings of the case, "key=value". Throws SettingsError.
io::Settings settings_of(const FlowCase& one, const Size& size,
                         const std::vector<std::string>& overrides = {});

class StartStates {
public:
  explicit StartStates(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The checkpoint of a case in a size; its name tells from what it was made. A kept one that
  /// cannot be read is made anew. Throws SettingsError, FileError.
  std::filesystem::path checkpoint(const FlowCase& one, const Size& size,
                                   const std::vector<std::string>& overrides = {}) const;

  const std::filesystem::path& folder() const { return folder_; }

private:
  std::filesystem::path folder_;
};

/// `copies` of a periodic state one after the other along y, each grain with its own small change
/// of velocity. At step 0, so that the lives of contacts begin anew.
State repeated(const State& tile, int copies);

}  // namespace riesel::bench
