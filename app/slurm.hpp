// A sweep as an array of Slurm jobs: each task does a part of it (sweep_parts.hpp) by `riesel
// sweep-task`, and is queued again when its time was not enough.
#pragma once

#include "io/sweep_manifest.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace riesel::app {

struct SlurmOptions {
  std::optional<std::size_t> tasks;     ///< at most [as many as are of use and Slurm takes]
  int threads = 1;                      ///< of each task
  std::vector<std::string> for_sbatch;  ///< "--partition=long", ...
};

/// How many tasks an array can have here: MaxArraySize as scontrol tells it. Nothing if there is no
/// Slurm.
std::optional<std::size_t> most_tasks_of_slurm();

/// The script for sbatch. The array has those tasks that have something to do: empty if none has.
/// `overrides`: "key=value", for each task; `time`: s, of each task, until it is queued again;
/// `most`: tasks that an array can have.
std::string slurm_script(const io::Manifest& manifest, const std::filesystem::path& sweep,
                         const std::vector<std::string>& overrides, const SlurmOptions& options,
                         std::optional<double> time, std::size_t most);

inline constexpr auto slurm_script_name = "slurm.sh";

/// Hands the script to sbatch. Returns the number of the job. Throws std::runtime_error if it does
/// not want it.
std::string submit_to_slurm(const std::filesystem::path& script);

}  // namespace riesel::app
