// Where a result comes from: the program, its build and libraries, the machine, the command and the
// settings. Stored in every run file, so that a number can be traced years later.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace riesel::io {

/// Names and values, in the order in which they are worth reading. Values may have several lines.
using Provenance = std::vector<std::pair<std::string, std::string>>;

/// What only the command knows about a run.
struct RunOrigin {
  std::vector<std::string> arguments;  ///< argv
  std::int64_t seed = 0;
  int threads = 1;
  std::string source;                     ///< the user's settings file, verbatim
  std::string settings;                   ///< the effective settings, YAML
  std::optional<std::uint64_t> run = {};  ///< see Checkpoint::run; only if the run can be resumed
  std::string continues = {};             ///< which state of which run it began with, or ""
};

/// The name of RunOrigin::run in a Provenance, where it has 16 hexadecimal digits.
inline constexpr auto run_key = "run";

/// The origin, the build, the libraries, the machine, the batch job if any, and the present time
/// (ISO 8601, UTC). What the system does not tell is "unknown".
Provenance collect_provenance(const RunOrigin& origin);

}  // namespace riesel::io
