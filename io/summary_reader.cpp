#include "io/summary_reader.hpp"

#include "io/checkpoint.hpp"
#include "io/file_error.hpp"
#include "io/json_file.hpp"
#include "io/shell_words.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace riesel::io {
namespace {

double number(const Json& json, const char* name) {
  const auto& value = json.at(name);
  return value.is_null() ? unknown : value.get<double>();
}

Measured measured(const Json& json) {
  return {.value = number(json, "value"), .error = number(json, "error")};
}

RunSummary read_run(const Json& json) {
  const auto& performance = json.at("performance");
  return {.scenario = json.at("scenario"),
          .grains = integer_of<std::int64_t>(json.at("grains")),
          .steps = integer_of<std::int64_t>(json.at("steps")),
          .state_hash = std::stoull(json.at("state_hash").get<std::string>(), nullptr, 16),
          .wall_seconds = number(performance, "wall_seconds"),
          .particle_steps_per_second = number(performance, "particle_steps_per_second"),
          .threads = integer_of<int>(performance.at("threads"))};
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

/// Of what is told of each wall; nothing if there is no right one.
std::optional<Measured> of_right_wall(const Json& json) {
  if (!json.contains("right")) return std::nullopt;
  return measured(json.at("right"));
}

FlowSummary::BrakingForce read_braking_force(const Json& json) {
  return {.left = measured(json.at("left")),
          .right = of_right_wall(json),
          .weight = number(json, "weight")};
}

FlowSummary::Energy read_energy(const Json& json) {
  return {.initial = number(json, "initial"),
          .kinetic = number(json, "kinetic"),
          .rotational = number(json, "rotational"),
          .elastic = number(json, "elastic"),
          .gravity_work = number(json, "gravity_work"),
          .wall_work = number(json, "wall_work"),
          .normal_loss = number(json, "normal_loss"),
          .friction_loss = number(json, "friction_loss"),
          .residual = number(json, "residual")};
}

auto read_counts(const Json& json) {
  decltype(FlowSummary::WallVisits::of_contacts) counts{};
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = integer_of<std::int64_t>(json.at(i));
  return counts;
}

FlowSummary::WallVisits read_wall_visits(const Json& json) {
  return {.visits = number(json, "visits"),
          .contacts = measured(json.at("contacts")),
          .dv_y = measured(json.at("dv_y")),
          .dv_x = measured(json.at("dv_x")),
          .entry_rate = measured(json.at("entry_rate")),
          .entry_slip = measured(json.at("entry_slip")),
          .of_contacts = read_counts(json.at("of_contacts_since_start"))};
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

/// Not known of flows of earlier versions.
Measured later_measured(const Json& json, const char* name) {
  return json.contains(name) ? measured(json.at(name)) : Measured{unknown, unknown};
}

FlowSummary::Zone read_zone(const Json& json) {
  return {.area_fraction = measured(json.at("area_fraction")),
          .mean_axial_velocity = measured(json.at("mean_axial_velocity")),
          .temperature_x = measured(json.at("temperature_x")),
          .temperature_y = measured(json.at("temperature_y")),
          .stress_xx = measured(json.at("stress_xx")),
          .stress_yy = measured(json.at("stress_yy")),
          .stress_xy = later_measured(json, "stress_xy"),
          .shear_rate = later_measured(json, "shear_rate"),
          .mean_spin = later_measured(json, "mean_spin"),
          .rotational_temperature = later_measured(json, "rotational_temperature")};
}

FlowSummary::WallPressure read_wall_pressure(const Json& json) {
  return {.left = later_measured(json, "left"), .right = of_right_wall(json)};
}

/// What `named` finds for the text. Throws std::runtime_error if there is no such `what`.
template <class Word>
Word word(const Json& json, std::optional<Word> (*named)(std::string_view), const char* what) {
  const auto text = json.get<std::string>();
  if (const auto found = named(text)) return *found;
  throw std::runtime_error(fmt::format("there is no {} {}", what, text));
}

Validity validity(const Json& json) { return word(json, validity_named, "verdict"); }

/// Its value, thresholds and verdict come from the file, its wording from this program.
Finding read_finding(const Json& json) {
  const std::string name = json.at("name");
  const double value = number(json, "value");
  auto finding = finding_named(name, value);
  if (!finding) throw std::runtime_error("there is no finding " + name);
  finding->suspect = number(json, "suspect");
  finding->unphysical = number(json, "unphysical");
  finding->low_is_bad = json.at("bad_if") == "below";
  finding->verdict = validity(json.at("verdict"));
  return *finding;
}

ValidityVerdict read_verdict(const Json& json) {
  ValidityVerdict verdict{.verdict = validity(json.at("verdict")), .findings = {}};
  for (const auto& finding : json.at("findings")) verdict.findings.push_back(read_finding(finding));
  return verdict;
}

CurveSummary read_curve(const Json& json) {
  CurveSummary summary{.run = read_run(json), .curve = {}};
  for (const auto& point : json.at("curve"))
    summary.curve.push_back({.v_x = number(point, "v_x"),
                             .v_y = number(point, "v_y"),
                             .dv_x = number(point, "dv_x"),
                             .dv_y = number(point, "dv_y"),
                             .contacts = number(point, "contacts"),
                             .contact_time = number(point, "contact_time"),
                             .max_overlap = number(point, "max_overlap"),
                             .passed = integer_of<int>(point.at("passed")),
                             .stuck = integer_of<int>(point.at("stuck")),
                             .cut_short = number(point, "cut_short"),
                             .brake_failure_fraction = number(point, "brake_failure_fraction"),
                             .verdict = validity(point.at("verdict")),
                             .cause = point.value("cause", std::string())});
  return summary;
}

ColumnSummary read_column(const Json& json) {
  const auto& rigid = json.at("rigid");
  ColumnSummary summary{.run = read_run(json),
                        .t_col = number(json, "t_col"),
                        .rigid = {.restitution = number(rigid, "restitution"),
                                  .rebound = number(rigid, "rebound"),
                                  .collisions = integer_of<std::int64_t>(rigid.at("collisions")),
                                  .collapsed = rigid.at("collapsed")},
                        .column = {}};
  for (const auto& point : json.at("column"))
    summary.column.push_back({.gap_ratio = number(point, "gap_ratio"),
                              .gap = number(point, "gap"),
                              .restitution = number(point, "restitution"),
                              .rebound = number(point, "rebound"),
                              .detachment = number(point, "detachment"),
                              .contacts = number(point, "contacts"),
                              .contact_time = number(point, "contact_time"),
                              .max_overlap = number(point, "max_overlap"),
                              .verdict = validity(point.at("verdict"))});
  return summary;
}

/// Flows of riesel 0.10 and before were judged by one series alone.
std::optional<JudgedBy> read_held_back_by(const Json& json) {
  const Json series = json.value("held_back_by", Json());
  if (series.is_null()) return std::nullopt;
  return word(series, judged_by_named, "held_back_by");
}

FlowSummary read_flow(const Json& json) {
  const auto& validity = json.at("validity");
  return {.run = read_run(json),
          .time = number(json, "time"),
          .transient_end = number(json, "transient_end"),
          .ended_by = word(json.at("ended_by"), ended_by_named, "ended_by"),
          .state = word(json.at("state"), steady_verdict_named, "state"),
          .judged_by = word(json.at("judged_by"), judged_by_named, "judged_by"),
          .held_back_by = read_held_back_by(json),
          .mean_axial_velocity = measured(json.at("mean_axial_velocity")),
          .mass_flow_rate = later_measured(json, "mass_flow_rate"),
          .independent_samples = number(json, "independent_samples"),
          .granular_temperature = number(json, "granular_temperature"),
          .fluctuations = read_fluctuations(json.at("fluctuations")),
          .structure_factor = read_structure_factor(json.at("structure_factor")),
          .core = read_zone(json.at("profiles").at("core")),
          .wall_layers = read_zone(json.at("profiles").at("wall_layers")),
          .balance = read_balance(json.at("balance")),
          .grain_contact_rate = measured(json.at("grain_contact_rate")),
          .braking_force = read_braking_force(json.at("braking_force")),
          .wall_pressure = read_wall_pressure(json.value("wall_pressure", Json::object())),
          .energy = read_energy(json.at("energy")),
          .wall_visits = read_wall_visits(json.at("wall_visits")),
          .validity = {.verdict = read_verdict(validity),
                       .v_crit = number(validity, "v_crit"),
                       .t_col_grains = number(validity.at("t_col"), "grains"),
                       .t_col_walls = number(validity.at("t_col"), "walls"),
                       .friction_failure_fraction = number(validity, "friction_failure_fraction"),
                       .warnings = validity.value("warnings", std::vector<std::string>{})}};
}

/// The version of riesel that wrote it; empty if it does not say.
std::string version_in(const Json& json) {
  const bool tells = json.is_object() && json.contains("version") && json["version"].is_string();
  return tells ? json["version"].get<std::string>() : "";
}

/// Throws FileError for another format. A file without a version, which riesel has not written, is
/// left to the caller.
void require_this_format(const std::filesystem::path& path, const Json& json) {
  const std::string version = version_in(json);
  if (version.empty()) return;
  const Json format = json.value("format", Json(1));
  if (format == summary_format) return;
  throw of_another_version(path,
                           fmt::format("has format {}, but this version of riesel reads {}",
                                       format.dump(), summary_format),
                           version);
}

}  // namespace

std::string remedy_for_summary(const std::filesystem::path& path) {
  const auto directory = path.parent_path();
  if (!std::filesystem::exists(directory / checkpoint_name))
    return "restore the file, or make the run again";
  return "restore the file, or make it anew by 'riesel resume " + path_argument(directory) + "'";
}

Summary read_summary(const std::filesystem::path& path) {
  const auto json = read_json(path, {.unreadable = "give the directory of a run that is over",
                                     .damaged = remedy_for_summary(path)});
  require_this_format(path, json);
  try {
    if (json.contains("curve")) return read_curve(json);
    if (json.contains("column")) return read_column(json);
    return read_flow(json);
  } catch (const std::exception& error) {
    // Names were added without a change of the format.
    reject_another_version(path, flaw_of(error), version_in(json));
    throw FileError(path, fmt::format("is damaged ({})", flaw_of(error)), remedy_for_summary(path));
  }
}

}  // namespace riesel::io
