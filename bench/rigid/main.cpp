// Rigid grains beside the soft ones of the engine (docs/paper.md, docs/performance.md).
//
//   build/bench/bench/rigid/rigid flows FILE.yaml ...   steady states of a tube of rigid grains, a
//   table build/bench/bench/rigid/rigid speed STATE.h5        how fast that is, in turns with the
//   engine
//
// Exit status: 1 if something fails, 2 for a wrong command line or settings.
#include "bench/rigid/rigid_flow.hpp"
#include "bench/rigid/rigid_record.hpp"
#include "bench/timing.hpp"
#include "engine/simulation.hpp"
#include "io/build_info.hpp"
#include "io/checkpoint.hpp"
#include "io/settings.hpp"
#include "io/settings_error.hpp"
#include "scenarios/scenario.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace riesel::bench {

namespace {

constexpr double usual_interval = 1e-7;  // s, the shortest between two impacts that lose energy
constexpr double between_rows = 10e-3;   // s

struct FlowsOptions {
  std::filesystem::path settings, out;
  std::vector<std::string> overrides;
  std::vector<double> restitutions, starts, shortest_intervals{usual_interval};
  int seeds = 1;
};

struct Point {
  double restitution, start, shortest_interval;
  int seed;
};

std::vector<Point> points(const FlowsOptions& options) {
  std::vector<Point> all;
  for (const double restitution : options.restitutions)
    for (const double start : options.starts)
      for (const double interval : options.shortest_intervals)
        for (int seed = 1; seed <= options.seeds; ++seed)
          all.push_back({.restitution = restitution,
                         .start = start,
                         .shortest_interval = interval,
                         .seed = seed});
  return all;
}

io::Settings settings_of(const FlowsOptions& options, const Point& point) {
  std::vector<std::string> all = options.overrides;
  all.push_back(fmt::format("contact.restitution={}", point.restitution));
  all.push_back(fmt::format("start.axial_velocity={}", point.start));
  all.push_back(fmt::format("seed={}", point.seed));
  return io::Settings::from_file(options.settings, scenarios::settings_tables(), all);
}

/// A row of the table.
std::string run(const FlowsOptions& options, const Point& point) {
  const io::Settings settings = settings_of(options, point);
  const auto flow =
      std::get<scenarios::Flow>(scenarios::named(settings.scenario()).prepare(settings));
  RigidFlow rigid(flow.state, flow.model, point.shortest_interval);
  RigidRecord record(rigid, between_rows);
  const auto rows = std::lround(settings.number("run.duration") / between_rows);
  for (long row = 0; row < rows; ++row) {
    rigid.advance(between_rows);
    record.add(rigid);
  }
  return fmt::format("{},{},{},{},{},{},{},{}\n", point.restitution, point.start,
                     point.shortest_interval, point.seed, rigid.size(),
                     static_cast<double>(rows) * between_rows, record.columns(flow.state.gravity.y),
                     build_info().git_commit.substr(0, 7));
}

/// The runs side by side; rows in the order of the points.
int flows(const FlowsOptions& options) {
  const std::vector<Point> all = points(options);
  settings_of(options, all.front());  // mistakes are told before anything runs
  std::vector<std::string> rows(all.size());
  std::vector<std::string> failures(all.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t i = 0; i < all.size(); ++i) {
    try {
      rows[i] = run(options, all[i]);
      fmt::print(stderr, "{}", rows[i]);
    } catch (const std::exception& error) {
      failures[i] = error.what();
    }
  }
  for (const std::string& failure : failures)
    if (!failure.empty()) throw std::runtime_error(failure);

  std::ofstream file(options.out);
  file << "e_n,start,shortest_interval,seed,grains,time," << RigidRecord::names << ",commit\n";
  for (const std::string& row : rows) file << row;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + options.out.string());
  return 0;
}

std::int64_t impacts_begun(const Tally& tally) { return tally.grains.begun + tally.walls.begun; }
std::int64_t impacts(const RigidCounts& counts) { return counts.impacts + counts.wall_impacts; }

/// Both go on from the same state for the same time, again and again.
int speed(const std::filesystem::path& path, double duration, int rounds) {
  const io::Checkpoint checkpoint = io::read_checkpoint(path);
  const ContactModel model = scenarios::contact_model(
      io::Settings::from_text(checkpoint.settings, "checkpoint", scenarios::settings_tables()));
  RigidFlow rigid(checkpoint.state, model, usual_interval);
  Simulation soft(checkpoint.state, model, 1, Stepping::windows);
  const auto steps = static_cast<std::int64_t>(duration / checkpoint.state.time_step);

  fmt::print("{} grains, {} s or {} steps at a time\n{:>10} {:>12} {:>10} {:>12} {:>7}\n",
             rigid.size(), duration, steps, "rigid, s", "impacts/s", "windows, s", "impacts/s",
             "ratio");
  for (int round = 0; round < rounds; ++round) {
    const std::int64_t rigid_before = impacts(rigid.counts());
    const std::int64_t soft_before = impacts_begun(soft.state().tally);
    const double of_rigid = seconds_of([&] { rigid.advance(duration); });
    const double of_soft = seconds_of([&] { soft.advance(steps); });
    const auto rigid_done = static_cast<double>(impacts(rigid.counts()) - rigid_before);
    const auto soft_done = static_cast<double>(impacts_begun(soft.state().tally) - soft_before);
    fmt::print("{:10.4f} {:12.0f} {:10.4f} {:12.0f} {:7.2f}\n", of_rigid, rigid_done / of_rigid,
               of_soft, soft_done / of_soft, of_soft / of_rigid);
  }
  return 0;
}

class CommandLine {
public:
  CommandLine() {
    program_.require_subcommand(1);
    add_flows();
    add_speed();
  }

  int run(int argc, char** argv) {
    try {
      program_.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return program_.exit(error) == 0 ? 0 : 2;
    }
    return flows_command_->parsed() ? flows(flows_) : speed(state_, duration_, rounds_);
  }

private:
  void add_flows() {
    flows_command_ = program_.add_subcommand("flows", "Steady states of a tube, a table");
    CLI::App& command = *flows_command_;
    command.add_option("settings", flows_.settings, "Of a tube; the stiffness does not count")
        ->required();
    command.add_option("--set", flows_.overrides, "Change a setting: key.path=value");
    command.add_option("--restitution", flows_.restitutions)->delimiter(',')->required();
    command.add_option("--start", flows_.starts, "m/s")->delimiter(',')->required();
    command
        .add_option("--shortest-interval", flows_.shortest_intervals,
                    "s; impacts that follow another one sooner are elastic")
        ->delimiter(',')
        ->check(CLI::PositiveNumber);
    command.add_option("--seeds", flows_.seeds)->check(CLI::PositiveNumber);
    command.add_option("--out", flows_.out, "CSV")->required();
  }

  void add_speed() {
    CLI::App& command = *program_.add_subcommand("speed", "In turns with windows, on one thread");
    command.add_option("state", state_, "A checkpoint")->required();
    command.add_option("--duration", duration_, "s, at a time")->check(CLI::PositiveNumber);
    command.add_option("--rounds", rounds_)->check(CLI::PositiveNumber);
  }

  CLI::App program_{"Rigid grains beside those of riesel"};
  CLI::App* flows_command_ = nullptr;
  FlowsOptions flows_;
  std::filesystem::path state_;
  double duration_ = 0.01;
  int rounds_ = 9;
};

}  // namespace

}  // namespace riesel::bench

int main(int argc, char** argv) {
  try {
    return riesel::bench::CommandLine().run(argc, argv);
  } catch (const riesel::io::SettingsError& error) {
    fmt::print(stderr, "rigid: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "rigid: {}\n", error.what());
    return 1;
  }
}
