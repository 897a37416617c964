#include "app/slurm.hpp"

#include "app/other_program.hpp"
#include "app/sweep_directory.hpp"
#include "app/sweep_parts.hpp"
#include "io/build_info.hpp"
#include "io/shell_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

/// "0-3,7" for {0, 1, 2, 3, 7}
std::string ranges_of(const std::vector<std::size_t>& numbers) {
  std::vector<std::string> ranges;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    ranges.push_back(last == i ? fmt::format("{}", numbers[i])
                               : fmt::format("{}-{}", numbers[i], numbers[last]));
    i = last + 1;
  }
  return fmt::format("{}", fmt::join(ranges, ","));
}

/// The parts in which at least one point is neither done nor failed.
std::vector<std::size_t> open_parts(const io::Manifest& manifest, std::size_t count) {
  std::set<std::string> over;
  for (const io::ManifestPoint& point : manifest.points)
    if (has_status(point, RunStatus::done) || has_status(point, RunStatus::failed))
      over.insert(point.name);
  const auto parts = parts_of(manifest, count);
  std::vector<std::size_t> open;
  for (std::size_t part = 0; part < count; ++part)
    if (!std::ranges::all_of(parts[part], [&](auto& name) { return over.contains(name); }))
      open.push_back(part);
  return open;
}

/// The path of a log, in which Slurm replaces %a by the number of the task, and %% by %.
std::string log_of_tasks(const fs::path& directory) {
  std::string pattern;
  for (const char c : (directory / "slurm").string())
    pattern += c == '%' ? "%%" : std::string(1, c);
  return pattern + "/%a.txt";
}

std::string name_of(const fs::path& sweep) {
  const fs::path path = fs::absolute(sweep).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

constexpr auto script_form = R"(#!/bin/bash
# Written by {writer}. Finished points are not run again, so this may be submitted at any time.
#SBATCH --job-name={name}
#SBATCH --array={array}
#SBATCH --cpus-per-task={threads}
#SBATCH --output={log}
#SBATCH --open-mode=append
#SBATCH --requeue
{more}
{riesel} sweep-task {sweep} "$SLURM_ARRAY_TASK_ID" --of {tasks} --threads {threads}{options} &
task=$!
trap 'late=1; again=1; kill -TERM $task' USR1  # the time is almost over: runs write checkpoints
trap 'again=1; kill -TERM $task' TERM          # cancelled, or another job comes first
again=1
while ((again)); do again=0; wait $task; status=$?; done  # a signal ends the wait, not the task

# 3: it has seen for itself that its time is almost over.
if ((status == 3)) || [[ -n "${{late-}}" && $status != 0 ]]; then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID"
fi
exit $status
)";

}  // namespace

std::optional<std::size_t> most_tasks_of_slurm() {
  const auto said = run_other_program({"scontrol", "show", "config"}, Complaints::hidden);
  if (!said || !said->how.is_success()) return {};
  constexpr std::string_view name = "MaxArraySize";
  const std::size_t place = said->output.find(name);
  if (place == std::string::npos) return {};
  const std::size_t digits = said->output.find_first_of("0123456789", place);
  if (digits == std::string::npos) return {};
  std::size_t size = 0;
  const auto [end, error] = std::from_chars(said->output.data() + digits,
                                            said->output.data() + said->output.size(), size);
  if (error != std::errc()) return {};
  return std::max<std::size_t>(size, 2) - 1;  // the largest index is smaller than the size
}

std::string slurm_script(const io::Manifest& manifest, const fs::path& sweep,
                         const std::vector<std::string>& overrides, const SlurmOptions& options,
                         std::optional<double> time, std::size_t most) {
  const std::size_t tasks = std::min({most_parts(manifest), most, options.tasks.value_or(most)});
  const auto open = open_parts(manifest, tasks);
  if (open.empty()) return {};
  // Slurm sends the signal up to two minutes before the end. That is too soon for short tasks,
  // which stop in time by their --max-walltime.
  constexpr double time_worth_a_signal = 600.0;  // s
  std::string more, for_tasks;
  if (!time || *time >= time_worth_a_signal) more += "#SBATCH --signal=B:USR1@60\n";
  if (time) {
    more += fmt::format("#SBATCH --time={:.0f}\n", std::ceil(*time / 60.0));
    for_tasks += " --max-walltime " + io::in_quotes(fmt::format("{} s", *time));
  }
  for (const std::string& setting : overrides) for_tasks += " --set " + io::in_quotes(setting);
  for (const std::string& option : options.for_sbatch) more += "#SBATCH " + option + "\n";
  const fs::path directory = fs::absolute(sweep).lexically_normal();
  return fmt::format(fmt::runtime(script_form), fmt::arg("writer", written_by()),
                     fmt::arg("name", io::in_quotes(name_of(sweep))),
                     fmt::arg("array", ranges_of(open)), fmt::arg("threads", options.threads),
                     fmt::arg("log", io::in_quotes(log_of_tasks(directory))),
                     fmt::arg("more", more),
                     fmt::arg("riesel", io::in_quotes(fs::read_symlink("/proc/self/exe").string())),
                     fmt::arg("sweep", io::in_quotes(directory.string())), fmt::arg("tasks", tasks),
                     fmt::arg("options", for_tasks));
}

std::string submit_to_slurm(const fs::path& script_file) {
  const auto said =
      run_other_program({"sbatch", "--parsable", script_file.string()}, Complaints::shown);
  if (!said)
    throw std::runtime_error("sbatch cannot be started; is Slurm installed on this machine?");
  if (!said->how.is_success())
    throw std::runtime_error(
        fmt::format("sbatch refused the job (see above); try again with other options (--sbatch), "
                    "or change {0} and call 'sbatch {0}'",
                    io::path_argument(script_file)));
  const std::size_t end = said->output.find_first_of(";\n");  // "JOB;CLUSTER"
  return said->output.substr(0, end);
}

}  // namespace riesel::app
