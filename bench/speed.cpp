// The benchmark suite: measures the cases of cases.cpp, prints a table, keeps the results as JSON.
// docs/suite.md tells what is measured and how to read it.
//
//   build/bench/bench/speed              a few minutes
//   build/bench/bench/speed --quick      less than a minute
//
// Exit status: 1 if hashes that must be equal are not, or the run fails; 2 for a wrong command
// line.
#include "bench/commands.hpp"
#include "bench/ensemble.hpp"
#include "bench/mistake.hpp"
#include "bench/other_rows.hpp"
#include "bench/output_place.hpp"
#include "io/durable_file.hpp"
#include "io/settings_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <stdexcept>
#include <system_error>

namespace {

using namespace riesel;
using namespace riesel::bench;

/// What the command line says.
struct Options {
  bool quick = false;
  std::vector<std::string> cases, sizes;  ///< to measure; empty: all
  std::string cache = RIESEL_BENCH_STATES;
  std::string out;  ///< empty: the usual place

  Effort effort() const {
    return quick ? Effort{.repetitions = 3, .work = 0.1} : Effort{.repetitions = 5, .work = 1.0};
  }
  bool part() const { return !cases.empty() || !sizes.empty(); }
  bool wants_case(const std::string& name) const { return wants(cases, name); }
  /// The largest only if asked for by name.
  bool wants_size(const Size& size) const {
    const int longest = quick ? size_named("10k").copies : size_named("1M").copies;
    return sizes.empty() ? size.copies <= longest : wants(sizes, size.name);
  }
  /// Of the cases that are about files and processes.
  Size bulk() const { return size_named(!sizes.empty() ? sizes.front() : quick ? "100k" : "1M"); }

private:
  static bool wants(const std::vector<std::string>& wanted, const std::string& name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
  }
};

/// A case of many grains in one of its sizes.
struct Flow {
  const FlowCase& one;
  Size size;
};

/// All variants of a case are alive at the same time.
bool fits(const Flow& flow, const Machine& machine) {
  constexpr double grains_per_copy = 1400.0, bytes_per_grain = 3500.0;  // of all variants together
  const double needed = flow.size.copies * grains_per_copy * bytes_per_grain;
  const bool enough = needed < static_cast<double>(machine.memory);
  if (!enough)
    fmt::print(stderr, "{} {}: left out, as it takes some {:.0f} GiB of memory\n", flow.one.name,
               flow.size.name, needed / 0x1p30);
  return enough;
}

/// Cases that are no flows of many grains.
std::vector<std::string> other_cases() {
  std::vector<std::string> names = {"checkpoint", "start_up", "ensemble"};
  for (const ImpactCase& one : impact_cases()) names.push_back(one.name);
  return names;
}

/// Of each case that is asked for there must be one of the sizes.
void reject_missing_sizes(const Options& options) {
  for (const FlowCase& one : flow_cases()) {
    const bool named = !options.cases.empty() && options.wants_case(one.name);
    if (named && std::ranges::none_of(one.sizes, [&](auto& s) { return options.wants_size(s); }))
      throw Mistake(one.name + ": has none of these sizes; 'speed list' tells which it has");
  }
}

/// Without those that do not fit into the memory.
std::vector<Flow> chosen_flows(const Options& options, const Machine& machine) {
  std::vector<Flow> chosen;
  for (const FlowCase& one : flow_cases())
    for (const Size& size : one.sizes)
      if (const Flow flow{one, size};
          options.wants_case(one.name) && options.wants_size(size) && fits(flow, machine))
        chosen.push_back(flow);
  return chosen;
}

/// Before anything is timed.
void make_all_states(const Options& options, const std::vector<Flow>& flows,
                     const StartStates& states) {
  for (const Flow& flow : flows) states.checkpoint(flow.one, flow.size);
  if (options.wants_case("checkpoint")) states.checkpoint(flow_case("tube_start"), options.bulk());
}

/// As much as plain stepping of a million grains moves per step, and far more than any cache holds.
void measure_bandwidths(const Options& options, Results& results) {
  for (const std::size_t mib : {std::size_t{160}, std::size_t{1536}}) {
    if (options.quick && mib > 160) continue;
    const auto measured = measure_bandwidth(mib << 20U, 2 * options.effort().repetitions);
    results.bandwidth.insert(results.bandwidth.end(), measured.begin(), measured.end());
  }
}

void measure_all(const Options& options, const std::vector<Flow>& flows, const StartStates& states,
                 Results& results) {
  const Effort effort = options.effort();
  print_heading();
  for (const ImpactCase& one : impact_cases())
    if (options.wants_case(one.name)) measure_impacts(one, effort, results);
  for (const Flow& flow : flows) measure_flow(flow.one, flow.size, states, effort, results);
  if (options.wants_case("checkpoint")) measure_checkpoint(options.bulk(), states, effort, results);
  if (options.wants_case("start_up")) measure_start_up(options.bulk(), effort, results);
  if (options.wants_case("ensemble"))
    measure_ensemble(RIESEL_COMMAND, states.folder(), effort, results);
}

int run_suite(const Options& options) {
  reject_missing_sizes(options);
  const StartStates states(options.cache);
  const std::vector<Flow> flows = chosen_flows(options, this_machine());
  if (flows.empty()
      && std::ranges::none_of(other_cases(), [&](auto& name) { return options.wants_case(name); }))
    throw Mistake("nothing that is asked for fits into the memory");
  Results results{.machine = this_machine(), .quick = options.quick, .part = options.part()};
  const std::filesystem::path out = options.out.empty() ? usual_place(results, RIESEL_BENCH_RESULTS)
                                                        : std::filesystem::path(options.out);
  reject_unfit_place(out);
  make_all_states(options, flows, states);
  measure_bandwidths(options, results);
  print_machine(results);
  measure_all(options, flows, states, results);

  io::write_durably(out, to_json(results).dump(1) + "\n");
  fmt::print("\nkept in {}\n", out.string());
  for (const std::string& disagreement : results.disagreements)
    fmt::print(stderr, "speed: not the same bits: {}\n", disagreement);
  return results.disagreements.empty() ? 0 : 1;
}

void list_cases() {
  for (const std::string& name : other_cases()) fmt::print("{}\n", name);
  for (const FlowCase& one : flow_cases()) {
    fmt::print("{}:", one.name);
    for (const Size& size : one.sizes) fmt::print(" {}", size.name);
    fmt::print("\n");
  }
}

/// Of many grains.
std::vector<std::string> known_flows() {
  std::vector<std::string> names;
  for (const FlowCase& one : flow_cases()) names.push_back(one.name);
  return names;
}

std::vector<std::string> known_cases() {
  std::vector<std::string> names = other_cases();
  for (const std::string& flow : known_flows()) names.push_back(flow);
  return names;
}

std::vector<std::string> known_sizes() {
  std::vector<std::string> names;
  for (const Size& size : flow_cases().front().sizes) names.push_back(size.name);
  return names;
}

/// The command line: the suite itself and the subcommands that serve it.
class CommandLine {
public:
  CommandLine() {
    program_.require_subcommand(0, 1);
    program_.add_flag("--quick", options_.quick, "Small sizes, short repetitions, fewer of them");
    program_.add_option("--case", options_.cases, "Measure this case; may be repeated")
        ->check(CLI::IsMember(known_cases()));
    program_.add_option("--size", options_.sizes, "Measure this size; may be repeated")
        ->check(CLI::IsMember(known_sizes()));
    program_.add_option("--out", options_.out, "The file of the results");
    program_.add_option("--states", options_.cache, "The folder in which start states are kept");
    program_.add_subcommand("list", "List the cases and their sizes")->callback([this] {
      command_ = [] {
        list_cases();
        return 0;
      };
    });
    program_.add_subcommand("origin", "Tell the machine and the build")->callback([this] {
      command_ = [] {
        fmt::print("{}\n", origin(this_machine()).dump(2));
        return 0;
      };
    });
    add_state();
    add_advance();
    add_start_up();
    add_barrier();
  }

  CLI::App& program() { return program_; }
  const std::function<int()>& command() const { return command_; }

private:
  void add_case_and_size(CLI::App& command) {
    command.add_option("case", case_)->required()->check(CLI::IsMember(known_flows()));
    command.add_option("size", size_)->required()->check(CLI::IsMember(known_sizes()));
  }

  void add_state() {
    CLI::App& command =
        *program_.add_subcommand("state", "Make a start state and tell where it is");
    add_case_and_size(command);
    command.add_option("--set", overrides_, "Change a setting: key.path=value; may be repeated");
    command.callback([this] {
      command_ = [this] {
        make_state(StartStates(options_.cache), case_, size_, overrides_);
        return 0;
      };
    });
  }

  void add_advance() {
    CLI::App& command = *program_.add_subcommand("advance", "Step a checkpoint and tell the time");
    command.add_option("checkpoint", advance_.checkpoint)->required();
    command.add_option("--stepping", advance_.variant.stepping)
        ->transform(CLI::CheckedTransformer(steppings()));
    command.add_option("--sharing", advance_.variant.sharing, "How threads share the steps")
        ->transform(CLI::CheckedTransformer(sharings()));
    command.add_option("--threads", advance_.variant.threads, "0: as many as pay")
        ->check(CLI::NonNegativeNumber);
    command.add_option("--warm-up", advance_.warm_up, "Steps before those that are timed")
        ->check(CLI::NonNegativeNumber);
    command.add_option("--steps", advance_.steps)->check(CLI::PositiveNumber);
    command.callback([this] {
      command_ = [this] {
        advance(advance_);
        return 0;
      };
    });
  }

  void add_start_up() {
    CLI::App& command =
        *program_.add_subcommand("start-up", "From settings to the first step done");
    add_case_and_size(command);
    command.add_option("--threads", threads_, "0: as many as pay")->check(CLI::NonNegativeNumber);
    command.callback([this] {
      command_ = [this] {
        start_up(case_, size_, threads_);
        return 0;
      };
    });
  }

  void add_barrier() {
    CLI::App& command = *program_.add_subcommand("barrier", "What waiting for each other takes");
    command.add_option("--threads", threads_, "2 if not given")->check(CLI::PositiveNumber);
    command.callback([this] {
      command_ = [this] {
        barrier(threads_ > 0 ? threads_ : 2);
        return 0;
      };
    });
  }

  CLI::App program_{"The benchmark suite of riesel"};
  Options options_;
  std::string case_, size_;
  std::vector<std::string> overrides_;
  AdvanceOptions advance_{.checkpoint = {},
                          .variant = {.name = {}, .stepping = Stepping::automatic, .threads = 0}};
  int threads_ = 0;
  std::function<int()> command_ = [this] { return run_suite(options_); };
};

}  // namespace

int main(int argc, char** argv) {
  try {
    CommandLine command_line;
    try {
      command_line.program().parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return command_line.program().exit(error) == 0 ? 0 : 2;
    }
    return command_line.command()();
  } catch (const io::SettingsError& mistake) {
    fmt::print(stderr, "speed: {}\n", mistake.what());
    return 2;
  } catch (const Mistake& mistake) {
    fmt::print(stderr, "speed: {}\n", mistake.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "speed: {}\n", error.what());
    return 1;
  }
}
