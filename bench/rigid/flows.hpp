// Steady states of a tube of rigid grains over e_N, start and seed: a table.
#pragma once

#include "bench/rigid/rigid_flow.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace riesel::bench {

struct FlowsOptions {
  std::filesystem::path settings;            ///< of a tube; its stiffness does not count
  std::vector<std::string> overrides;        ///< "key=value"
  std::vector<double> restitutions, starts;  ///< starts in m/s
  std::vector<double> shortest_intervals{usual_interval};  ///< s
  int seeds = 1;
  std::filesystem::path out;  ///< CSV
};

/// Runs all points side by side and writes their table, one row for each, in the order in which the
/// lists go. Throws SettingsError and Mistake before anything runs; std::runtime_error for what
/// fails then.
void run_flows(const FlowsOptions& options);

}  // namespace riesel::bench
