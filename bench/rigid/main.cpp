// Rigid grains beside the soft ones of the engine:
//
//   rigid flows FILE.yaml ...   steady states of a tube of rigid grains, a table (docs/paper.md)
//   rigid speed STATE.h5        how fast that is, in turns with the engine (docs/performance.md)
//
// Exit status: 1 if something fails, 2 for a wrong command line or settings.
#include "bench/mistake.hpp"
#include "bench/rigid/beside_windows.hpp"
#include "bench/rigid/flows.hpp"
#include "io/settings_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <exception>
#include <filesystem>

namespace riesel::bench {

namespace {

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
    if (flows_command_->parsed())
      run_flows(flows_);
    else
      beside_windows(state_, duration_, rounds_);
    return 0;
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
  } catch (const riesel::bench::Mistake& error) {
    fmt::print(stderr, "rigid: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "rigid: {}\n", error.what());
    return 1;
  }
}
