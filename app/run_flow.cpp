#include "app/run_flow.hpp"

#include "app/clock.hpp"
#include "app/exit_status.hpp"
#include "app/flow_failures.hpp"
#include "app/flow_measurements.hpp"
#include "app/flow_result.hpp"
#include "app/flow_summary.hpp"
#include "app/interrupt.hpp"
#include "app/limit_watch.hpp"
#include "app/pace.hpp"
#include "app/plain_words.hpp"
#include "app/print_profile.hpp"
#include "app/print_summary.hpp"
#include "app/progress.hpp"
#include "app/run_files.hpp"
#include "app/schedule.hpp"
#include "app/series.hpp"
#include "app/steadiness.hpp"
#include "app/stepping.hpp"
#include "app/terminal.hpp"
#include "app/time_limit.hpp"
#include "engine/hash.hpp"
#include "engine/simulation.hpp"
#include "engine/time_blocks.hpp"
#include "io/file_error.hpp"
#include "io/provenance.hpp"
#include "io/summary.hpp"
#include "scenarios/run_limits.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace riesel::app {

namespace {

/// A limit that is set by the settings, with limits.action: stop.
struct LimitExceeded : RunFailure {
  using RunFailure::RunFailure;
};

/// See Checkpoint::run.
std::uint64_t identity_of(const io::Settings& settings, const State& start) {
  Hash hash;
  hash.add_text(settings.effective_yaml());
  hash.add(state_hash(start));
  return hash.value();
}

/// What a run that goes on brings from its checkpoint; of a new run, `rows` is 0.
struct Past {
  std::string source;          // the user's settings file, verbatim
  std::string continues = {};  // see io::RunOrigin
  std::uint64_t run = 0;
  std::vector<std::string> warnings = {};
  bool had_other_settings = false;  // such as a shorter duration
  std::int64_t rows = 0;
  double wall_seconds = 0.0;
  TimeBlocks profiles = {}, histograms = {};
};

class FlowRun {
public:
  FlowRun(io::Settings settings, const ContactModel& model, State state, RunDirectory directory,
          const Arguments& arguments, Past past, const FlowOptions& options)
      : settings_(std::move(settings)),
        past_(std::move(past)),
        verbosity_(options.verbosity),
        schedule_(settings_, state.time_step),
        threads_(threads_for(settings_, state.grains.size())),
        simulation_(std::move(state), model, threads_, stepping_of(settings_)),
        run_(goes_on() ? past_.run : identity_of(settings_, simulation_.state())),
        limits_(scenarios::run_limits(settings_), past_.warnings),
        files_(std::move(directory), origin(arguments), past_.rows, simulation_.state(),
               schedule_.steps_per_frame),
        measurements_(goes_on()
                          ? FlowMeasurements(simulation_.state(), past_.profiles, past_.histograms)
                          : FlowMeasurements(simulation_.state())),
        progress_(options.verbosity),
        time_limit_(options.max_walltime),
        first_step_(simulation_.state().step) {
    if (options.profile) simulation_.start_profile();
  }

  int run() {
    start_ = last_checkpoint_ = Clock::now();
    if (goes_on()) set_aside_ = files_.directory().go_on(settings_, is_over());
    tell_beginning();
    try {
      set_out();
      while (!is_over() && !is_interrupted()) advance();
    } catch (const LimitExceeded& failure) {
      return fail(failure, way_on_without(key_of_limit(failure.what())));
    } catch (const RunFailure& failure) {
      return fail(failure, "");
    }
    progress_.finish();
    save();
    return is_over() ? tell_result() : tell_interruption();
  }

private:
  io::RunOrigin origin(const Arguments& arguments) const {
    return {.arguments = arguments,
            .seed = settings_.integer("seed"),
            .threads = threads_,
            .source = past_.source,
            .settings = settings_.effective_yaml(),
            .run = run_,
            .continues = past_.continues};
  }

  bool goes_on() const { return past_.rows > 0; }

  void set_out() {
    if (!goes_on()) begin();
    if (past_.had_other_settings) keep_settings();
    if (goes_on()) {
      if (!is_over() || past_.had_other_settings) files_.directory().drop_report();
      look_where_it_stopped();
    }
    if (time_limit_.asks_to_save(files_.rows())) save();
  }

  /// Writes the first row, frame and checkpoint; from here on the run can be resumed.
  void begin() {
    add_frame();
    add_row();
    save();
  }

  /// Writes the changed settings into both generations of the checkpoint, so that after a kill the
  /// run goes on with them whichever of the two is used. If not even the first can be written, the
  /// run is as it was.
  void keep_settings() {
    try {
      write_checkpoint();
    } catch (const io::FileError&) {
      if (set_aside_) files_.directory().go_back(*set_aside_);
      throw;
    }
    write_checkpoint();
  }

  bool is_over() const {
    return simulation_.state().step >= schedule_.last_step || is_precise_enough();
  }

  /// Judged with each new row. A run that is resumed is judged at once, as it may be at its end.
  bool is_precise_enough() const {
    return schedule_.is_row(simulation_.state().step) && steadiness().is_precise_enough();
  }

  Steadiness steadiness() const {
    return {files_.record(), judged_by(simulation_.state(), interval()), schedule_.relative_error};
  }

  /// Notes the error bar so far, for the line of progress.
  void note_precision() {
    if (!steadiness().is_looked_at()) return;
    const SteadyState so_far = steadiness().state();
    precision_so_far_ =
        fmt::format("  error {:.2g} % of {:.2g} %", 100.0 * so_far.error / std::abs(so_far.mean),
                    100.0 * *schedule_.relative_error);
    tell_more("t = {:.6g} s:{}", simulation_.state().time(), precision_so_far_);
  }

  /// s, between two rows.
  double interval() const {
    return static_cast<double>(schedule_.steps_per_row) * simulation_.state().time_step;
  }

  bool is_interrupted() const { return interrupting_signal() != 0 || time_limit_.is_reached(); }

  io::EndedBy ended_by() const {
    if (!schedule_.relative_error) return io::EndedBy::duration;
    return is_precise_enough() ? io::EndedBy::precision : io::EndedBy::at_most;
  }

  /// Steps to the next row, frame or look, or part of the way there, so that signals and the clock
  /// are heeded in time.
  void advance() {
    const State& state = simulation_.state();
    const auto start = Clock::now();
    const std::int64_t steps = std::min(schedule_.next(state.step) - state.step, pace_.steps());
    simulation_.advance(steps);
    const double seconds = seconds_since(start);
    times_.stepping += seconds;
    time_limit_.note_piece(seconds);
    pace_.note(steps, seconds);
    if (schedule_.is_frame(state.step)) add_frame();
    if (schedule_.is_row(state.step))
      add_row();
    else if (schedule_.is_look(state.step))
      look();
    if (seconds_since(last_checkpoint_) > schedule_.seconds_between_checkpoints
        || time_limit_.asks_to_save(files_.rows()))
      save();
    progress_.show(static_cast<double>(state.step) / static_cast<double>(schedule_.last_step),
                   fmt::format("t = {:.4f} s  {}{}", state.time(), present(), precision_so_far_));
  }

  /// The quantity by which the flow is judged, at the last row.
  std::string present() const {
    const Observables& now = measurements_.last();
    const bool by_temperature =
        judged_by(simulation_.state(), interval()).series == io::JudgedBy::granular_temperature;
    return by_temperature ? fmt::format("T = {:.4g} m^2/s^2", now.granular_temperature)
                          : fmt::format("mean v_y = {:.4f} m/s", now.mean_vy);
  }

  void add_frame() {
    const auto start = Clock::now();
    files_.add_frame(simulation_.state());
    times_.output += seconds_since(start);
  }

  void add_row() {
    const auto start = Clock::now();
    fail_if_out_of_range(simulation_.state());
    measurements_.add(simulation_);
    times_.measuring += seconds_since(start);
    files_.record().append(series_row(measurements_.last(), simulation_.state().tally));
    note_precision();
    heed_limits();
  }

  /// Repeats the look at the step where the run stopped, if one was due there; otherwise only
  /// updates the observables, for progress and summary.
  void look_where_it_stopped() {
    if (schedule_.is_row(first_step_) || schedule_.is_look(first_step_))
      look();
    else
      measurements_.look(simulation_.state());
  }

  void look() {
    fail_if_out_of_range(simulation_.state());
    measurements_.look(simulation_.state());
    heed_limits();
  }

  void heed_limits() {
    const Observables& seen = measurements_.last();
    fail_if_through_a_wall(simulation_.state(), seen);
    for (const std::string& message : limits_.newly_exceeded(simulation_.state(), seen)) {
      if (limits_.stops()) throw LimitExceeded(message);
      progress_.finish();
      tell("riesel: {}\n", message);
    }
  }

  io::Checkpoint checkpoint() const {
    return {.state = simulation_.state(),
            .settings = settings_.effective_yaml(),
            .source = past_.source,
            .run = run_,
            .warnings = limits_.warnings(),
            .rows = files_.rows(),
            .wall_seconds = wall_seconds(),
            .profiles = measurements_.profiles(),
            .histograms = measurements_.histograms()};
  }

  void write_checkpoint() const {
    io::write_checkpoint(files_.directory().file(io::checkpoint_name), checkpoint());
  }

  /// Series and trajectory first, as the checkpoint records how many rows and frames there are.
  void save() {
    const auto start = Clock::now();
    files_.flush(simulation_.state(), simulation_.model());
    write_checkpoint();
    last_checkpoint_ = Clock::now();
    const double seconds = seconds_since(start);
    times_.output += seconds;
    time_limit_.note_save(seconds, files_.rows());
    tell_more("checkpoint at t = {:.6g} s, {} rows, in {:.3f} s", simulation_.state().time(),
              files_.rows(), seconds);
  }

  /// Prints if the run is verbose.
  template <class... Parts>
  void tell_more(fmt::format_string<Parts...> format, Parts&&... parts) {
    if (verbosity_ != Verbosity::verbose) return;
    progress_.finish();
    tell("{}\n", fmt::format(format, std::forward<Parts>(parts)...));
  }

  void tell_beginning() {
    const State& state = simulation_.state();
    if (goes_on() && verbosity_ != Verbosity::quiet)
      tell("{}: goes on from t = {:.6g} s, step {} of {}\n", files_.directory().path().string(),
           state.time(), state.step, schedule_.last_step);
    tell_more("{}: {} grains, {} to {} steps of {:.4g} s on {}", files_.directory().path().string(),
              state.grains.size(), state.step, schedule_.last_step, state.time_step,
              so_many(threads_, "thread"));
  }

  /// A resume that has nothing to do counts for nothing, so that it leaves the checkpoint as it
  /// was.
  double wall_seconds() const {
    const bool did_nothing = goes_on() && simulation_.state().step == first_step_;
    return past_.wall_seconds + (did_nothing ? 0.0 : seconds_since(start_));
  }

  io::RunSummary run_summary() const {
    const State& state = simulation_.state();
    const auto grains = static_cast<double>(state.grains.size());
    const double seconds = wall_seconds();
    return {.scenario = settings_.scenario(),
            .grains = static_cast<std::int64_t>(state.grains.size()),
            .steps = state.step,
            .state_hash = state_hash(state),
            .wall_seconds = seconds,
            .particle_steps_per_second = grains * static_cast<double>(state.step) / seconds,
            .threads = threads_};
  }

  int tell_result() {
    files_.directory().require_in_place();
    const io::RunSummary run = run_summary();  // first: its time is to exclude the assessment below
    const State& state = simulation_.state();
    const SteadyState steady = steadiness().state();
    io::FlowSummary s = summarise({.file = files_.record(),
                                   .steady = steady,
                                   .strips = measurements_.strips(),
                                   .profiles = measurements_.profiles(),
                                   .interval = interval(),
                                   .warnings = limits_.warnings()},
                                  state, simulation_.model(), measurements_.last());
    s.run = run;
    s.ended_by = ended_by();
    write_result(s, measurements_, state.tally, static_cast<std::int64_t>(steady.transient_end),
                 interval(), files_);
    if (verbosity_ != Verbosity::quiet) print_summary(s, files_.directory().path());
    if (simulation_.profile().on()) print_profile(simulation_, times_, state.step - first_step_);
    return exit_done;
  }

  int tell_interruption() const {
    const bool by_signal = interrupting_signal() != 0;
    tell("{} at t = {:.6g} s; '{}' goes on from there\n",
         by_signal ? "interrupted" : "out of time (--max-walltime)", simulation_.state().time(),
         call_of("resume", files_.directory().path()));
    return by_signal ? 128 + interrupting_signal() : exit_out_of_time;
  }

  /// `limit`: the key of the one that was exceeded.
  std::string way_on_without(std::string_view limit) const {
    return fmt::format("; to go on from there, remove the limit or set another: '{} --set {}='",
                       call_of("resume", files_.directory().file(post_mortem_name)), limit);
  }

  /// Keeps the series and the state, which may show why the run failed.
  int fail(const RunFailure& failure, const std::string& way_on) {
    progress_.finish();
    tell("riesel: the run failed: {}\n", failure.what());  // the last message: a sweep keeps it
    try {
      files_.flush(simulation_.state(), simulation_.model());
      const auto post_mortem = files_.directory().file(post_mortem_name);
      io::write_checkpoint(post_mortem, checkpoint());
      tell("the state of that moment is in {}{}\n", post_mortem.string(), way_on);
    } catch (const std::exception& error) {
      tell("the state of that moment could not be kept: {}\n", error.what());
    }
    return exit_failed;
  }

  const io::Settings settings_;
  const Past past_;
  const Verbosity verbosity_;
  const Schedule schedule_;
  const int threads_;
  Simulation simulation_;
  const std::uint64_t run_;  // see Checkpoint::run
  LimitWatch limits_;
  RunFiles files_;
  FlowMeasurements measurements_;
  Progress progress_;
  Pace pace_;
  TimeLimit time_limit_;
  std::optional<RunDirectory::SetAside> set_aside_;  // when the run went on
  std::string precision_so_far_;                     // for the line of progress
  const std::int64_t first_step_;
  Clock::time_point start_, last_checkpoint_;
  RunTimes times_;
};

}  // namespace

int run_flow(const io::Settings& settings, scenarios::Flow flow, RunDirectory directory,
             const Arguments& arguments, const FlowOptions& options) {
  catch_interrupts();
  const Past nothing{.source = settings.source_text(),
                     .continues = flow.continues ? flow.continues->identity : ""};
  return FlowRun(settings, flow.model, std::move(flow.state), std::move(directory), arguments,
                 nothing, options)
      .run();
}

int resume_flow(const io::Settings& settings, io::Checkpoint checkpoint, RunDirectory directory,
                const Arguments& arguments, const FlowOptions& options) {
  catch_interrupts();
  const Past past{.source = checkpoint.source,
                  .run = checkpoint.run,
                  .warnings = std::move(checkpoint.warnings),
                  .had_other_settings = checkpoint.settings != settings.effective_yaml(),
                  .rows = checkpoint.rows,
                  .wall_seconds = checkpoint.wall_seconds,
                  .profiles = std::move(checkpoint.profiles),
                  .histograms = std::move(checkpoint.histograms)};
  return FlowRun(settings, scenarios::contact_model(settings), std::move(checkpoint.state),
                 std::move(directory), arguments, past, options)
      .run();
}

}  // namespace riesel::app
