#include "app/sweep_runner.hpp"

#include "app/child_process.hpp"
#include "app/clock.hpp"
#include "app/exit_status.hpp"
#include "app/interrupt.hpp"
#include "app/plain_words.hpp"
#include "app/progress.hpp"
#include "app/run_directory.hpp"
#include "app/terminal.hpp"
#include "app/walltime.hpp"
#include "io/directory_lock.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/run_record.hpp"
#include "io/summary.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

using namespace std::chrono_literals;

constexpr auto between_looks = 10ms;
constexpr auto between_manifests = 2s;     // or more, where telling takes long:
constexpr double part_for_telling = 0.02;  // of the time of a core, at most
constexpr int most_starts = 3;             // of one run in one sweep, if signals keep stopping it
constexpr int most_collisions = 20;  // of a run with others that have its directory for a moment
constexpr auto log_name = "log.txt";

/// The run of one directory; equal points share it.
struct Job {
  const io::ManifestPoint* point = nullptr;
  std::string name;
  fs::path directory;
  Job* parent = nullptr;
  double seconds = 0.0;  // expected, on one thread
  double urgency = 0.0;  // s, together with the longest chain of runs that waits for it
  int most_threads = 1;
  RunStatus status = RunStatus::waiting;
  std::string reason;  // why it failed
  int starts = 0, collisions = 0;
  std::unique_ptr<ChildProcess> process;
  Clock::time_point started = {};
  std::uintmax_t log_begin = 0;  // bytes of the log before this start
};

/// The last error message in the log of a run after byte `begin`; "" if there is none.
std::string complaint_in(const fs::path& log, std::uintmax_t begin) {
  constexpr std::string_view speaker = "riesel: ";
  std::ifstream stream(log);
  stream.seekg(static_cast<std::streamoff>(begin));
  std::string complaint;
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(speaker)) complaint = line.substr(speaker.size());
  return complaint;
}

/// By somebody or something outside of it, such as a limit or a batch system, so that it can go on.
bool was_ended_from_outside(const ProcessEnd& end) {
  constexpr std::array from_outside = {SIGINT, SIGTERM, SIGHUP, SIGKILL, SIGXCPU, SIGUSR1, SIGUSR2};
  const int by_signal = end.signal != 0 ? end.signal : end.status - 128;
  return std::ranges::find(from_outside, by_signal) != from_outside.end();
}

class Runner {
public:
  Runner(io::Manifest& manifest, fs::path sweep, const std::vector<std::string>& names,
         const SweepRunOptions& options)
      : manifest_(manifest),
        sweep_(std::move(sweep)),
        names_(names),
        options_(options),
        misplaced_(note_misplaced(manifest, sweep_, names)) {
    for (const io::ManifestPoint& point : manifest.points)
      if (is_among(names, point.name)) add(point);
    order_by_urgency();
  }

  /// If this does not end by itself, all runs are to stop, and none is to wait for the others.
  ~Runner() { send_to_all(SIGTERM); }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;
  Runner(Runner&&) = delete;
  Runner& operator=(Runner&&) = delete;

  int run() {
    catch_interrupts();
    while (true) {
      for (const auto& job : jobs_)
        if (job->process) look_after(*job);
      pass_signal_on();
      const bool more = ending_signal() == 0 && start_what_can();
      if (!more && running_ == 0) break;
      show_progress();
      if (options_.on_change && Clock::now() > next_manifest_) tell_manifest();
      std::this_thread::sleep_for(between_looks);
    }
    progress_.finish();
    update_manifest();
    if (options_.on_change) options_.on_change(manifest_);
    if (interrupting_signal() != 0) return 128 + interrupting_signal();
    if (count(RunStatus::done) == jobs_.size()) return exit_done;
    const bool is_out_of_time =
        passed_on_ && std::ranges::any_of(jobs_, [](auto& job) { return can_go_on(*job); });
    return is_out_of_time ? exit_out_of_time : exit_failed;
  }

private:
  void add(const io::ManifestPoint& point) {
    if (by_name_.contains(point.name)) return;
    auto job = std::make_unique<Job>();
    job->point = &point;
    job->name = point.name;
    job->directory = point_directory(sweep_, point.name);
    if (const auto parent = by_name_.find(point.parent); parent != by_name_.end())
      job->parent = parent->second;
    job->seconds = point.expected_seconds * options_.prolongation.part_left(job->directory);
    job->most_threads = point.most_threads;
    look_at(*job);
    if (misplaced_.contains(job->name)) {  // until its directory is put back
      job->status = RunStatus::failed;
      job->reason = point.reason;
    } else if (job->status == RunStatus::failed && options_.retry_failed
               && can_begin(job->directory)) {
      job->status = RunStatus::interrupted;
    }
    by_name_.emplace(job->name, job.get());
    jobs_.push_back(std::move(job));
  }

  void look_at(Job& job) const {
    if (misplaced_.contains(job.name)) return;
    const RunStanding standing = options_.prolongation.standing_of(job.directory);
    job.status = standing.status;
    job.reason = standing.reason;
  }

  void order_by_urgency() {
    for (std::size_t i = jobs_.size(); i-- > 0;) {  // children before their parents
      Job& job = *jobs_[i];
      job.urgency += job.seconds;
      if (job.parent != nullptr) job.parent->urgency = std::max(job.parent->urgency, job.urgency);
    }
    for (const auto& job : jobs_) by_urgency_.push_back(job.get());
    std::stable_sort(by_urgency_.begin(), by_urgency_.end(),
                     [](const Job* a, const Job* b) { return a->urgency > b->urgency; });
  }

  std::size_t count(RunStatus status) const {
    return static_cast<std::size_t>(std::count_if(
        jobs_.begin(), jobs_.end(), [&](auto& job) { return job->status == status; }));
  }

  static bool is_ready(const Job& job) {
    const bool open = job.status == RunStatus::waiting || job.status == RunStatus::interrupted;
    const bool may_start = job.parent == nullptr || job.parent->status == RunStatus::done;
    return open && may_start && job.starts < most_starts && !job.process;
  }

  /// Whether another sweep would go on with it, or wait for it.
  static bool can_go_on(const Job& job) {
    if (job.status == RunStatus::done || job.status == RunStatus::failed) return false;
    return job.parent == nullptr || job.parent->status == RunStatus::done || can_go_on(*job.parent);
  }

  /// Starts what is ready while there is room. Returns whether there is anything left to wait for,
  /// besides the processes started here.
  bool start_what_can() {
    if (running_ >= options_.jobs) return true;  // nor need the others be looked at
    bool more = false;
    for (Job* job : by_urgency_) {
      // Another process works on it; when that ends, the point may be done or not.
      if (job->status == RunStatus::running && !job->process) look_at(*job);
      const bool here = is_ready(*job);
      more = more || here || job->status == RunStatus::running;
      if (here && running_ < options_.jobs) start(*job);
    }
    return more;
  }

  /// An equal share of the cores for each run that is running or ready.
  int threads_for(const Job& job) const {
    const auto ready = static_cast<int>(
        std::count_if(jobs_.begin(), jobs_.end(), [](auto& other) { return is_ready(*other); }));
    const int side_by_side = std::min(options_.jobs, running_ + ready);
    return std::clamp(options_.cores / std::max(1, side_by_side), 1, job.most_threads);
  }

  /// A point that cannot be started fails alone, but not for want of processes, which all need.
  void start(Job& job) {
    try {
      start_process(job);
    } catch (const NoProcess&) {
      throw;
    } catch (const std::runtime_error& error) {
      fail_unless_in_use(job, error.what());
    }
  }

  void start_process(Job& job) {
    const int threads = threads_for(job);
    look_at(job);
    const bool in_vain = job.status == RunStatus::failed && !options_.retry_failed;
    if (job.status == RunStatus::running || job.status == RunStatus::done || in_vain) return;
    ++job.starts;
    if (const auto reason = reason_not_to_start(manifest_, *job.point, sweep_); !reason.empty())
      return fail(job, reason);
    if (!can_resume(job.directory) && !cleared(job)) return;
    const bool goes_on = can_resume(job.directory);  // another process may have begun it meanwhile
    const std::vector<std::string> changes = options_.prolongation.overrides_for(job.directory);
    const int before = io::read_run_record(job.directory).attempts;
    const int attempts = before < std::numeric_limits<int>::max() ? before + 1 : before;
    io::write_run_record(job.directory, {.attempts = attempts, .failure = "", .changes = changes});

    const std::string directory = job.directory.string();
    std::vector<std::string> arguments = {"resume", directory};
    if (!goes_on)
      arguments = {"run", (job.directory / point_settings_name).string(), "--out", directory};
    arguments.insert(arguments.end(), {"--threads", std::to_string(threads)});
    for (const std::string& setting : changes)
      arguments.insert(arguments.end(), {"--set", setting});
    const auto log = job.directory / log_name;
    std::error_code no_log;
    const std::uintmax_t log_size = fs::file_size(log, no_log);
    job.log_begin = no_log ? 0 : log_size;
    job.process = std::make_unique<ChildProcess>(arguments, log);
    ++running_;
    job.started = Clock::now();
    job.status = RunStatus::running;
  }

  /// Removes what an earlier run has left. Returns false if another process has taken the point.
  bool cleared(Job& job) const {
    try {
      clear(job.directory);
      return true;
    } catch (const io::FileError&) {
      look_at(job);
      if (job.status == RunStatus::running || job.status == RunStatus::done) return false;
      throw;
    }
  }

  void look_after(Job& job) {
    const std::optional<ProcessEnd> end = job.process->end();
    if (!end) return;
    job.process.reset();
    --running_;
    look_at(job);
    const bool taken_by_another = job.status == RunStatus::running;
    if (job.status == RunStatus::done || taken_by_another) return;
    if (was_ended_from_outside(*end)) {
      job.status = RunStatus::interrupted;
      if (job.starts == most_starts && ending_signal() == 0)
        tell_of("point {} was stopped {} times; '{}' goes on with it", job, most_starts,
                call_of("sweep", sweep_));
      return;
    }
    fail_unless_in_use(job, reason_of(job, *end));
  }

  /// Another process, such as 'riesel report', may have the directory just when the run begins, and
  /// have left it since: then there is nothing wrong with the run.
  void fail_unless_in_use(Job& job, const std::string& reason) {
    const bool in_use = reason.find(io::in_use_by) != std::string::npos;
    if (!in_use || job.collisions == most_collisions) return fail(job, reason);
    ++job.collisions;
    --job.starts;
    job.status = RunStatus::interrupted;
  }

  static std::string reason_of(const Job& job, const ProcessEnd& end) {
    if (end.signal != 0) return fmt::format("crashed ({})", strsignal(end.signal));
    const std::string complaint = complaint_in(job.directory / log_name, job.log_begin);
    return complaint.empty() ? fmt::format("ended with status {}", end.status) : complaint;
  }

  void fail(Job& job, const std::string& reason) {
    job.status = RunStatus::failed;
    job.reason = reason;
    tell_of("point {} failed: {}", job, reason);
    try {
      io::RunRecord record = io::read_run_record(job.directory);
      record.failure = reason;
      io::write_run_record(job.directory, record);
    } catch (const io::FileError&) {  // the next sweep has to try again
    }
  }

  template <class... Parts>
  void tell_of(fmt::format_string<const std::string&, const Parts&...> format, const Job& job,
               const Parts&... parts) {
    progress_.finish();
    tell("riesel: {}\n", fmt::format(format, job.name, parts...));
  }

  /// The signal by which the runs are to be stopped, or 0. Comes before the time is over, as the
  /// runs need some time to write their checkpoints.
  int ending_signal() const {
    constexpr double most_reserve = 60.0;  // s
    if (interrupting_signal() != 0 || !options_.max_walltime) return interrupting_signal();
    const double reserve = std::min(most_reserve, 0.1 * *options_.max_walltime);
    const bool time_is_over = seconds_since_start_of_program() > *options_.max_walltime - reserve;
    return time_is_over ? SIGTERM : 0;
  }

  void pass_signal_on() {
    const int signal = ending_signal();
    if (signal == 0 || passed_on_) return;
    passed_on_ = true;
    send_to_all(signal);
  }

  void send_to_all(int signal) const {
    for (const auto& job : jobs_)
      if (job->process) job->process->send(signal);
  }

  /// A run that takes longer than expected counts as almost done.
  double fraction_done() const {
    constexpr double almost = 0.95;
    double done = 0.0, all = 0.0;
    for (const auto& job : jobs_) {
      all += job->seconds;
      if (job->status == RunStatus::done || job->status == RunStatus::failed) done += job->seconds;
      if (job->process) done += std::min(almost * job->seconds, seconds_since(job->started));
    }
    return all > 0.0 ? done / all : 1.0;
  }

  void show_progress() {
    if (!progress_.is_due()) return;
    const std::size_t failed = count(RunStatus::failed);
    progress_.show(fraction_done(),
                   fmt::format("{}/{} runs done, {} running{}", count(RunStatus::done),
                               jobs_.size(), running_,
                               failed > 0 ? fmt::format(", {} failed", failed) : ""));
  }

  void tell_manifest() {
    const Clock::time_point begin = Clock::now();
    update_manifest();
    options_.on_change(manifest_);
    const Clock::time_point end = Clock::now();
    const auto rest = std::chrono::duration_cast<Clock::duration>((end - begin) / part_for_telling);
    next_manifest_ = end + std::max<Clock::duration>(between_manifests, rest);
  }

  void update_manifest() {
    refresh(manifest_, sweep_, names_);
    for (io::ManifestPoint& point : manifest_.points) {
      const auto job = by_name_.find(point.name);
      if (job == by_name_.end() || job->second->status != RunStatus::failed) continue;
      point.status = to_string(RunStatus::failed);  // refresh() may say done: it failed to go on
      point.reason = job->second->reason;
    }
  }

  io::Manifest& manifest_;
  const fs::path sweep_;
  const std::vector<std::string>& names_;
  const SweepRunOptions& options_;
  const std::set<std::string> misplaced_;
  std::vector<std::unique_ptr<Job>> jobs_;  // a parent before its children
  std::map<std::string, Job*> by_name_;
  std::vector<Job*> by_urgency_;
  Progress progress_{Verbosity::normal};
  Clock::time_point next_manifest_ = {};
  int running_ = 0;  // processes
  bool passed_on_ = false;
};

}  // namespace

int cores() { return omp_get_max_threads(); }

int run_points(io::Manifest& manifest, const fs::path& sweep, const std::vector<std::string>& names,
               const SweepRunOptions& options) {
  return Runner(manifest, sweep, names, options).run();
}

}  // namespace riesel::app
