// A sweep file: many runs in one page of YAML. A base (a settings file), overrides for all, axes
// along which settings vary, seeds, branches, and the axis along which runs continue each other.
//
// Only the plan is read here. Values stay YAML nodes that know their place in the file, and become
// overrides of the base: they pass the same checks as a settings file, and their errors point into
// the sweep file. See sweep_points.hpp for how the plan is carried out, docs/sweeps.md for the
// user's view.
#pragma once

#include "io/settings_table.hpp"
#include "io/settings_yaml.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace riesel::io {

/// That a number, which stands for 1, 2, ..., can ask for.
inline constexpr std::int64_t most_seeds = 10'000;

/// Settings that vary together: one key, or several that are zipped.
struct SweepAxis {
  std::vector<std::string> keys;               ///< dotted
  std::vector<std::vector<YamlEntry>> values;  ///< for each place on the axis, one entry per key
};

/// A named set of overrides, such as a slow and a fast start.
struct SweepBranch {
  std::string name;
  std::vector<YamlEntry> overrides;
};

/// The axis along which each run starts from the final state of its neighbour.
struct SweepContinuation {
  std::size_t axis = 0;  ///< index into SweepFile::axes
  Place place;
};

struct SweepFile {
  std::string source;    ///< the file's name
  std::string text;      ///< verbatim
  std::string scenario;  ///< that of the base
  YamlNode base;         ///< the map of settings

  std::vector<YamlEntry> overrides;  ///< for all runs
  std::vector<SweepAxis> axes;
  std::vector<SweepBranch> branches;
  std::vector<YamlEntry> seeds;  ///< overrides of `seed`
  std::optional<SweepContinuation> continuation;
};

/// Reads a sweep file and its base. All its keys are then known to the scenario, none is set twice,
/// and no axis is empty; values are not checked, except where a range is spread out. Throws
/// SettingsError.
SweepFile read_sweep_file(const std::filesystem::path& file, const SettingsTables& tables);

/// The same from text; a base that is a path is relative to the directory of `source`.
SweepFile read_sweep_text(const std::string& text, const std::string& source,
                          const SettingsTables& tables);

}  // namespace riesel::io
