// The command riesel: reads the command line, calls a subcommand, turns errors into messages and
// exit status.
#include "app/command.hpp"

#include "app/child_process.hpp"
#include "app/command_words.hpp"
#include "app/commands.hpp"
#include "app/completion.hpp"
#include "app/exit_status.hpp"
#include "app/interrupt.hpp"
#include "app/option_values.hpp"
#include "app/terminal.hpp"
#include "app/walltime.hpp"
#include "engine/simulation.hpp"
#include "io/build_info.hpp"
#include "io/file_error.hpp"
#include "io/settings_error.hpp"
#include "io/settings_names.hpp"
#include "io/settings_table.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace riesel;

std::string version_text() {
  const BuildInfo& build = build_info();
  return fmt::format("riesel {} ({}{}, {}, {})", build.version, build.git_commit,
                     build.git_dirty ? ", changed" : "", build.compiler, build.build_type);
}

constexpr std::size_t most_jobs = 1024;
constexpr std::size_t most_tasks = 10'000'000;

CLI::Option* add_set(CLI::App& command, std::vector<std::string>& overrides,
                     const std::string& what) {
  return command.add_option("--set", overrides, what + "; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
}

void add_overrides(CLI::App& command, std::vector<std::string>& overrides) {
  add_set(command, overrides, "Change a setting: key.path=value");
}

/// --set of the commands that go on with the runs of a sweep.
CLI::Option* add_changes(CLI::App& command, std::vector<std::string>& overrides) {
  return add_set(command, overrides,
                 "Extend all runs, including finished ones, e.g. run.duration='4 s'");
}

void add_threads(CLI::App& command, std::vector<std::string>& overrides) {
  command.add_option_function<std::string>(
      "--threads", [&](const std::string& n) { overrides.push_back("run.threads=" + n); },
      "Number of threads, or 'auto'; the results do not depend on it");
}

CLI::Option* add_max_walltime(CLI::App& command, std::optional<double>& max_walltime,
                              const std::string& what) {
  return command.add_option_function<std::string>(
      "--max-walltime", [&](const std::string& time) { max_walltime = app::read_walltime(time); },
      what);
}

void add_flow_options(CLI::App& command, app::FlowOptions& options) {
  command.add_flag("--profile", options.profile, "Show where the time went; for flows");
  add_max_walltime(command, options.max_walltime,
                   "Stop with a checkpoint before this much wall-clock time, such as '23.5 h', has "
                   "passed; for flows");
}

void add_verbosity(CLI::App& command, app::Verbosity& verbosity) {
  const auto set = [&verbosity](app::Verbosity to) { return [&verbosity, to] { verbosity = to; }; };
  CLI::Option* quiet =
      command.add_flag_callback("-q,--quiet", set(app::Verbosity::quiet),
                                "Print errors and warnings only; results are in the files");
  command
      .add_flag_callback("-v,--verbose", set(app::Verbosity::verbose),
                         "Also report the start of the run and each checkpoint")
      ->excludes(quiet);
}

/// What the command line says: the subcommand, ready to be called, and its options.
class CommandLine {
public:
  CommandLine(int argc, char** argv) : arguments_(argv, argv + argc) {
    program_.set_version_flag("--version", version_text());
    program_.footer("'riesel help COMMAND' shows the options of a command.");
    program_.require_subcommand(0, 1);  // so that a wrong one is named; see command()
    add_run();
    add_resume();
    add_check();
    add_directory("report", "Make a page with figures of a run that is over, or of a sweep",
                  "the run or the sweep", app::report);
    add_sweep();
    add_sweep_task();
    add_directory("status", "Show how far a sweep has come", "the sweep", app::sweep_status);
    add_directory("collect", "Gather the results of a sweep into one table", "the sweep",
                  app::sweep_collect);
    add_new();
    program_.add_subcommand("scenarios", "List the scenarios")->callback([this] {
      command_ = app::list_scenarios;
    });
    program_.add_subcommand("settings", "Print the reference of all settings, in Markdown")
        ->callback([this] { command_ = app::print_settings; });
    add_schema();
    add_completion();
    program_.add_subcommand("man", "Print the manual page, in roff")->callback([this] {
      command_ = [this] { return print(app::man_page(program_)); };
    });
  }

  /// Throws CLI::ParseError, and app::UnusableInput for an unknown subcommand.
  void parse() {
    std::vector<std::string> words(arguments_.begin() + 1, arguments_.end());
    if (!words.empty() && words.front() == "help") {  // "help run" means "run --help"
      while (!words.empty() && words.front() == "help") words.erase(words.begin());
      words.emplace_back("--help");
    }
    if (!words.empty() && !words.front().starts_with('-')) refuse_unknown_command(words.front());
    std::ranges::reverse(words);  // the order that CLI11 takes
    program_.parse(words);
  }

  const CLI::App& program() const { return program_; }
  const std::function<int()>& command() const { return command_; }

private:
  void add_run() {
    CLI::App* run = program_.add_subcommand("run", "Run a settings file");
    CLI::Option* file = run->add_option("FILE", run_.file, "Settings in YAML");
    run->add_option("--out", run_.directory, "Directory for the results [runs/NAME]")
        ->transform(app::some_name());
    add_overrides(*run, run_.overrides);
    add_threads(*run, run_.overrides);
    add_flow_options(*run, run_.flow);
    add_verbosity(*run, run_.flow.verbosity);
    set_command(*run, *file, [this] { return app::run(run_, arguments_); });
  }

  void add_resume() {
    CLI::App* resume =
        program_.add_subcommand("resume", "Go on with a run from its last checkpoint");
    CLI::Option* directory = resume->add_option("DIR", resume_.checkpoint,
                                                "Directory of the run, or a checkpoint in it");
    add_overrides(*resume, resume_.overrides);
    add_threads(*resume, resume_.overrides);
    add_flow_options(*resume, resume_.flow);
    add_verbosity(*resume, resume_.flow.verbosity);
    set_command(*resume, *directory, [this] { return app::resume(resume_, arguments_); });
  }

  void add_check() {
    CLI::App* check = program_.add_subcommand(
        "check", "Validate a settings file and tell what it means: t_col, e_N, time step, cost");
    CLI::Option* file = check->add_option("FILE", check_.file, "Settings in YAML");
    add_overrides(*check, check_.overrides);
    add_threads(*check, check_.overrides);
    set_command(*check, *file, [this] { return app::check(check_); });
  }

  void add_sweep() {
    CLI::App* sweep = program_.add_subcommand(
        "sweep", "Run all points of a sweep file that are not done, side by side");
    CLI::Option* file = sweep->add_option(
        "FILE", sweep_.file, "Sweep in YAML, or the directory of a sweep, to go on with it");
    sweep->add_option("--out", sweep_.directory, "Directory for the results [sweeps/NAME]")
        ->transform(app::some_name());
    CLI::Option* jobs =
        sweep->add_option("--jobs", sweep_.jobs, "Runs side by side [as many as cores]")
            ->transform(app::whole_number(1, most_jobs));
    sweep->add_flag("--dry-run", sweep_.dry_run, "List the points, their directories and cost");
    CLI::Option* prepare = sweep->add_flag("--prepare", sweep_.prepare_only,
                                           "Write the plan for sweep-task, run nothing");
    CLI::Option* retry =
        sweep->add_flag("--retry-failed", sweep_.retry_failed, "Run again what failed");
    CLI::Option* walltime = add_max_walltime(
        *sweep, sweep_.max_walltime,
        "Stop with checkpoints before this much wall-clock time, such as '23.5 h', has passed; "
        "with --slurm: the time of each task, which is queued again then");
    CLI::Option* changes = add_changes(*sweep, sweep_.overrides);
    add_slurm(*sweep)->excludes(jobs)->excludes(prepare);
    prepare->excludes(changes)->excludes(jobs)->excludes(retry)->excludes(walltime);
    set_command(*sweep, *file, [this] { return app::sweep(sweep_); });
  }

  CLI::Option* add_slurm(CLI::App& sweep) {
    CLI::Option* slurm = sweep.add_flag("--slurm", sweep_.to_slurm,
                                        "Submit the sweep to Slurm; --dry-run shows the script");
    sweep
        .add_option("--tasks", sweep_.slurm.tasks,
                    "Maximum number of Slurm tasks [one per point, or chain of points, as far as "
                    "Slurm allows]")
        ->transform(app::whole_number(1, most_tasks))
        ->needs(slurm);
    sweep.add_option("--threads", sweep_.slurm.threads, "Threads of each task of Slurm [1]")
        ->transform(app::whole_number(1, io::most_threads))
        ->needs(slurm);
    sweep
        .add_option("--sbatch", sweep_.slurm.for_sbatch,
                    "Option for sbatch, such as --sbatch=--partition=long; may be repeated")
        ->take_all()
        ->allow_extra_args(false)
        ->needs(slurm);
    return slurm;
  }

  void add_sweep_task() {
    CLI::App* task = program_.add_subcommand(
        "sweep-task", "Run a point or a part of a sweep, for a batch system");
    task->add_option("DIR", task_.directory, "Directory of the sweep, see sweep --prepare");
    CLI::Option* index = task->add_option("INDEX", task_.index, "The point, counted from 0")
                             ->transform(app::whole_number(0, most_tasks - 1));
    task->add_option("--of", task_.parts, "Split the sweep into this many parts; INDEX is the part")
        ->transform(app::whole_number(1, most_tasks));
    task->add_option("--threads", task_.threads, "Threads [as many as cores]")
        ->transform(app::whole_number(1, io::most_threads));
    add_max_walltime(*task, task_.max_walltime,
                     "Stop with checkpoints before this much wall-clock time has passed");
    task->add_flag("--retry-failed", task_.retry_failed, "Run it again if it failed");
    add_changes(*task, task_.overrides);
    set_command(*task, *index, [this] { return app::sweep_task(task_); });
  }

  void add_new() {
    CLI::App* made = program_.add_subcommand("new", "Write a settings file to begin with");
    CLI::Option* scenario =
        made->add_option("SCENARIO", new_file_.scenario, "See 'riesel scenarios'");
    made->add_option("FILE", new_file_.file, "File to write [SCENARIO.yaml]")
        ->transform(app::some_name());
    set_command(*made, *scenario, [this] { return app::new_file(new_file_); });
  }

  void add_completion() {
    CLI::App* completion = program_.add_subcommand(
        "completion",
        "Print a script that completes the command line: eval \"$(riesel completion bash)\"");
    const std::vector<std::string> known(app::shells.begin(), app::shells.end());
    CLI::Option* shell =
        completion->add_option("SHELL", shell_, fmt::format("{}", fmt::join(known, " or ")))
            ->check(CLI::IsMember(known));
    set_command(*completion, *shell, [this] {
      return print(shell_ == "bash" ? app::bash_completion(program_)
                                    : app::zsh_completion(program_));
    });
  }

  void refuse_unknown_command(const std::string& name) const {
    std::vector<std::string> names;
    for (const app::Subcommand& known : app::subcommands_of(program_)) names.push_back(known.name);
    if (std::ranges::find(names, name) != names.end()) return;
    const auto question = io::did_you_mean(name, names);
    throw app::UnusableInput(fmt::format("there is no command '{}'; {}see 'riesel --help'", name,
                                         question ? *question + " " : ""));
  }

  static int print(const std::string& text) {
    fmt::print("{}", text);
    return app::exit_done;
  }

  void add_schema() {
    CLI::App* schema = program_.add_subcommand(
        "schema",
        "Print the JSON Schema of settings files, for editors that complete and check YAML");
    schema->add_flag("--sweep", schema_of_sweeps_, "Print the schema of sweep files instead");
    schema->callback(
        [this] { command_ = [this] { return app::print_schema(schema_of_sweeps_); }; });
  }

  /// A subcommand whose only argument is the directory of a run or a sweep.
  void add_directory(const std::string& name, const std::string& what, const std::string& of,
                     int (*act)(const std::filesystem::path&)) {
    CLI::App* subcommand = program_.add_subcommand(name, what);
    CLI::Option* directory = subcommand->add_option("DIR", directory_, "Directory of " + of);
    set_command(*subcommand, *directory, [this, act] { return act(directory_); });
  }

  /// The argument is required, but this is checked only after CLI11 has complained about unknown
  /// options, which says more about what is wrong.
  void set_command(CLI::App& subcommand, const CLI::Option& argument,
                   const std::function<int()>& command) {
    subcommand.callback([this, &argument, command] {
      if (argument.count() == 0) throw CLI::RequiredError(argument.get_name());
      command_ = command;
    });
  }

  const app::Arguments arguments_;
  CLI::App program_{"riesel: molecular dynamics of rapid granular flow",
                    program_invocation_short_name};
  app::RunOptions run_;
  app::ResumeOptions resume_;
  app::CheckOptions check_;
  app::SweepOptions sweep_;
  app::SweepTaskOptions task_;
  app::NewFileOptions new_file_;
  std::filesystem::path directory_;
  bool schema_of_sweeps_ = false;
  std::string shell_;
  std::function<int()> command_;
};

/// Prints the message; each line begins with the name of the program.
int fail(int status, const char* message) noexcept {
  std::fputs("riesel: ", stderr);
  for (const char* letter = message; *letter != '\0'; ++letter) {
    std::fputc(*letter, stderr);
    if (*letter == '\n') std::fputs("riesel: ", stderr);
  }
  std::fputc('\n', stderr);
  return status;
}

int fail_to_print() noexcept {
  return fail(app::exit_failed,
              app::nobody_reads_the_output()
                  ? "the reader of the output has closed it; results computed so far are on disk"
                  : "the output could not be written; free some space");
}

int fail_for_want_of_memory() noexcept {
  return fail(app::exit_failed, "out of memory; choose fewer grains");
}

/// In a parallel region an exception cannot be thrown: the other threads would wait for ever.
void give_up_without_memory() {
  if (omp_in_parallel() == 0) throw std::bad_alloc();
  _exit(fail_for_want_of_memory());
}

/// Standard output is buffered, so that an error may show only when it is flushed at the end.
int tell_if_not_printed(int status) {
  const bool printed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  return printed || status != app::exit_done ? status : fail_to_print();
}

/// OpenMP crashes where there is no memory for so many threads as OMP_NUM_THREADS may ask for.
void limit_threads() {
  if (omp_get_max_threads() > io::most_threads) omp_set_num_threads(io::most_threads);
}

/// Reads the command line and does what it says.
int run_program(int argc, char** argv) {
  app::occupy_closed_streams();
  app::heed_ends_of_children();
  app::end_on_interrupts();
  std::signal(SIGXFSZ, SIG_IGN);  // so that a write beyond the limit of a file fails with EFBIG
  std::set_new_handler(give_up_without_memory);
  limit_threads();
  CommandLine line(argc, argv);
  try {
    line.parse();
    if (!line.command()) throw CLI::RequiredError::Subcommand(1);
  } catch (const CLI::ParseError& error) {
    const bool asks_for_text = error.get_exit_code() == 0;
    if (asks_for_text) return line.program().exit(error);
    throw app::UnusableInput(std::string(error.what()) + "; see 'riesel --help'");
  }
  return line.command()();
}

}  // namespace

int riesel::app::command(int argc, char** argv) {
  try {
    return tell_if_not_printed(run_program(argc, argv));
  } catch (const io::SettingsError& error) {
    return fail(app::exit_bad_input, error.what());
  } catch (const app::UnusableInput& error) {
    return fail(app::exit_bad_input, error.what());
  } catch (const std::bad_alloc&) {
    return fail_for_want_of_memory();
  } catch (const std::filesystem::filesystem_error& error) {
    const auto told = io::system_failure(error.path1(), "cannot be reached", error.code().value());
    return fail(app::exit_failed, told.what());
  } catch (const std::exception& error) {
    return std::ferror(stdout) != 0 ? fail_to_print() : fail(app::exit_failed, error.what());
  }
}
