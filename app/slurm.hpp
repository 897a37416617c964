// A sweep as an array of Slurm jobs: each task does a part of it (sweep_parts.hpp) by `riesel
// sweep-task`, and is queued again if its time was not enough.
#pragma once

#include "io/sweep_manifest.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace riesel::app {

struct SlurmOptions {
  std::optional<std::size_t> tasks;     ///< at most [as many as are useful and Slurm allows]
  int threads = 1;                      ///< of each task
  std::vector<std::string> for_sbatch;  ///< "--partition=long", ...
};

/// How many tasks an array can have here, from the MaxArraySize that scontrol reports. Nothing if
/// it cannot be asked.
std::optional<std::size_t> most_tasks_of_slurm();

/// The script for sbatch. Its array consists of the tasks that have something left to do; "" if
/// none has. `overrides`: "key=value", for each task; `time`: s of real time for each task, which
/// is queued again when it is over; `most`: the number of tasks that an array can have.
std::string slurm_script(const io::Manifest& manifest, const std::filesystem::path& sweep,
                         const std::vector<std::string>& overrides, const SlurmOptions& options,
                         std::optional<double> time, std::size_t most);

inline constexpr auto slurm_script_name = "slurm.sh";

/// Submits the script with sbatch. Returns the number of the job; "" if sbatch does not tell it.
/// Throws std::runtime_error if sbatch cannot be started or refuses the script.
std::string submit_to_slurm(const std::filesystem::path& script);

}  // namespace riesel::app
