#include "io/summary_reader.hpp"

#include "io/file_error.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

namespace riesel::io {
namespace {

using Json = nlohmann::ordered_json;

double number(const Json& json, const char* name) {
  const auto& value = json.at(name);
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Measured measured(const Json& json) {
  return {.value = number(json, "value"), .error = number(json, "error")};
}

RunSummary read_run(const Json& json) {
  const auto& performance = json.at("performance");
  return {.scenario = json.at("scenario"),
          .grains = json.at("grains"),
          .steps = json.at("steps"),
          .state_hash = std::stoull(json.at("state_hash").get<std::string>(), nullptr, 16),
          .wall_seconds = number(performance, "wall_seconds"),
          .particle_steps_per_second = number(performance, "particle_steps_per_second"),
          .threads = performance.at("threads")};
}

FlowSummary::Balance read_balance(const Json& json) {
  const auto& errors = json.at("errors");
  const auto with_error = [&](const char* name) {
    return Measured{.value = number(json, name), .error = number(errors, name)};
  };
  return {.n_dot = with_error("n_dot"),
          .dv_y = with_error("dv_y"),
          .n_dot_dv_y = with_error("n_dot_dv_y"),
          .gravity = number(json, "gravity")};
}

FlowSummary::Energy read_energy(const Json& json) {
  return {.initial = number(json, "initial"),
          .kinetic = number(json, "kinetic"),
          .elastic = number(json, "elastic"),
          .gravity_work = number(json, "gravity_work"),
          .normal_loss = number(json, "normal_loss"),
          .friction_loss = number(json, "friction_loss"),
          .residual = number(json, "residual")};
}

FlowSummary::WallVisits read_wall_visits(const Json& json) {
  return {.visits = number(json, "visits"),
          .contacts = measured(json.at("contacts")),
          .dv_y = measured(json.at("dv_y")),
          .dv_x = measured(json.at("dv_x")),
          .entry_rate = measured(json.at("entry_rate")),
          .entry_slip = measured(json.at("entry_slip")),
          .of_contacts = json.at("of_contacts_since_start")};
}

FlowSummary::Fluctuations read_fluctuations(const Json& json) {
  return {.sigma_vx = measured(json.at("sigma_vx")),
          .sigma_vy = measured(json.at("sigma_vy")),
          .granular_temperature = measured(json.at("granular_temperature"))};
}

std::array<Measured, density_waves> read_structure_factor(const Json& json) {
  std::array<Measured, density_waves> factor{};
  for (std::size_t n = 1; n <= factor.size(); ++n)
    factor[n - 1] = measured(json.at(std::to_string(n)));
  return factor;
}

FlowSummary::Zone read_zone(const Json& json) {
  return {.area_fraction = measured(json.at("area_fraction")),
          .mean_axial_velocity = measured(json.at("mean_axial_velocity")),
          .temperature_x = measured(json.at("temperature_x")),
          .temperature_y = measured(json.at("temperature_y")),
          .stress_xx = measured(json.at("stress_xx")),
          .stress_yy = measured(json.at("stress_yy"))};
}

/// The findings stand in the order of Evidence.
ValidityVerdict read_verdict(const Json& json) {
  const auto& findings = json.at("findings");
  const auto value = [&](std::size_t i) { return number(findings.at(i), "value"); };
  ValidityVerdict verdict = judge({.max_overlap_ratio = value(0),
                                   .brake_failure_fraction = value(1),
                                   .passages_per_visit = value(2),
                                   .wall_speed_ratio = value(3),
                                   .pulling_fraction = value(4),
                                   .steps_per_contact = value(5)});
  bool same = findings.size() == verdict.findings.size()
              && json.at("verdict") == std::string(name(verdict.verdict));
  for (std::size_t i = 0; same && i < findings.size(); ++i)
    same = findings[i].at("name") == std::string(verdict.findings[i].name)
           && findings[i].at("verdict") == std::string(name(verdict.findings[i].verdict));
  if (!same) throw std::runtime_error("its findings are judged otherwise by this version");
  return verdict;
}

FlowSummary read_flow(const Json& json) {
  const auto& validity = json.at("validity");
  return {.run = read_run(json),
          .time = number(json, "time"),
          .transient_end = number(json, "transient_end"),
          .ended_by = json.value("ended_by", "duration"),  // once all runs did
          .state = json.at("state"),
          .mean_axial_velocity = measured(json.at("mean_axial_velocity")),
          .independent_samples = number(json, "independent_samples"),
          .granular_temperature = number(json, "granular_temperature"),
          .fluctuations = read_fluctuations(json.at("fluctuations")),
          .structure_factor = read_structure_factor(json.at("structure_factor")),
          .core = read_zone(json.at("profiles").at("core")),
          .wall_layers = read_zone(json.at("profiles").at("wall_layers")),
          .balance = read_balance(json.at("balance")),
          .energy = read_energy(json.at("energy")),
          .wall_visits = read_wall_visits(json.at("wall_visits")),
          .validity = {.verdict = read_verdict(validity),
                       .v_crit = number(validity, "v_crit"),
                       .friction_failure_fraction = number(validity, "friction_failure_fraction")}};
}

}  // namespace

FlowSummary read_flow_summary(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) throw FileError(path, "cannot be read", "give the directory of a run that is over");
  const auto json = Json::parse(stream, nullptr, false);
  if (json.is_object() && json.contains("curve"))
    throw FileError(path, "is the result of an impact scenario, and reports are made of flows",
                    "plot 'curve' of this file instead");
  try {
    return read_flow(json);
  } catch (const std::exception& error) {
    throw FileError(path, fmt::format("is damaged, or of another version ({})", error.what()),
                    "restore the file, or make the run again with this version");
  }
}

}  // namespace riesel::io
