#include "io/summary.hpp"

#include "engine/named.hpp"
#include "io/build_info.hpp"
#include "io/json_file.hpp"

#include <fmt/core.h>

#include <string_view>

namespace riesel::io {

namespace {

constexpr std::array<Word<EndedBy>, 3> ends = {{{EndedBy::duration, "duration"},
                                                {EndedBy::precision, "precision"},
                                                {EndedBy::at_most, "at_most"}}};
constexpr std::array<Word<JudgedBy>, 3> judged_series = {
    {{JudgedBy::mean_vy, "mean_vy"},
     {JudgedBy::granular_temperature, "granular_temperature"},
     {JudgedBy::rotational_temperature, "rotational_temperature"}}};

Json common_part(const RunSummary& run) {
  return {{"format", summary_format},
          {"scenario", run.scenario},
          {"version", std::string(build_info().version)},
          {"commit", std::string(build_info().git_commit)},
          {"grains", run.grains},
          {"steps", run.steps},
          {"state_hash", fmt::format("{:016x}", run.state_hash)},
          {"performance",
           {{"wall_seconds", run.wall_seconds},
            {"particle_steps_per_second", run.particle_steps_per_second},
            {"threads", run.threads}}}};
}

Json measured(const Measured& m) { return {{"value", m.value}, {"error", m.error}}; }

Json wall_visits(const FlowSummary::WallVisits& v) {
  return {{"visits", v.visits},
          {"contacts", measured(v.contacts)},
          {"dv_y", measured(v.dv_y)},
          {"dv_x", measured(v.dv_x)},
          {"entry_rate", measured(v.entry_rate)},
          {"entry_slip", measured(v.entry_slip)},
          {"of_contacts_since_start", v.of_contacts}};
}

Json fluctuations(const FlowSummary::Fluctuations& f) {
  return {{"sigma_vx", measured(f.sigma_vx)},
          {"sigma_vy", measured(f.sigma_vy)},
          {"granular_temperature", measured(f.granular_temperature)}};
}

/// By the number of periods along the tube.
Json structure_factor(const std::array<Measured, density_waves>& factor) {
  Json json;
  for (std::size_t n = 1; n <= factor.size(); ++n)
    json[std::to_string(n)] = measured(factor[n - 1]);
  return json;
}

Json zone(const FlowSummary::Zone& z) {
  return {{"area_fraction", measured(z.area_fraction)},
          {"mean_axial_velocity", measured(z.mean_axial_velocity)},
          {"temperature_x", measured(z.temperature_x)},
          {"temperature_y", measured(z.temperature_y)},
          {"stress_xx", measured(z.stress_xx)},
          {"stress_yy", measured(z.stress_yy)},
          {"stress_xy", measured(z.stress_xy)},
          {"shear_rate", measured(z.shear_rate)},
          {"mean_spin", measured(z.mean_spin)},
          {"rotational_temperature", measured(z.rotational_temperature)}};
}

Json balance(const FlowSummary::Balance& b) {
  return {{"n_dot", b.n_dot.value},
          {"dv_y", b.dv_y.value},
          {"n_dot_dv_y", b.n_dot_dv_y.value},
          {"gravity", b.gravity},
          {"errors",
           {{"n_dot", b.n_dot.error}, {"dv_y", b.dv_y.error}, {"n_dot_dv_y", b.n_dot_dv_y.error}}}};
}

Json by_wall(const Measured& left, const std::optional<Measured>& right) {
  Json json = {{"left", measured(left)}};
  if (right) json["right"] = measured(*right);
  return json;
}

Json braking_force(const FlowSummary::BrakingForce& f) {
  Json json = by_wall(f.left, f.right);
  json["weight"] = f.weight;
  return json;
}

/// A threshold that no value passes stands as null.
Json findings(const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const Finding& f : findings)
    list.push_back({{"name", f.name},
                    {"value", f.value},
                    {"suspect", f.suspect},
                    {"unphysical", f.unphysical},
                    {"bad_if", f.low_is_bad ? "below" : "above"},
                    {"verdict", name(f.verdict)}});
  return list;
}

Json validity(const FlowSummary& s) {
  const ValidityVerdict& v = s.validity.verdict;
  return {{"verdict", name(v.verdict)},
          {"max_overlap_ratio", v.value_of("max_overlap_ratio")},
          {"brake_failure_fraction", v.value_of("brake_failure_fraction")},
          {"friction_failure_fraction", s.validity.friction_failure_fraction},
          {"contacts_per_wall_visit", s.wall_visits.contacts.value},
          {"v_crit", s.validity.v_crit},
          {"t_col", {{"grains", s.validity.t_col_grains}, {"walls", s.validity.t_col_walls}}},
          {"findings", findings(v.findings)},
          {"warnings", s.validity.warnings}};
}

}  // namespace

std::string_view name(EndedBy ended_by) { return name_in(ends, ended_by); }

std::string_view name(JudgedBy judged_by) { return name_in(judged_series, judged_by); }

std::optional<EndedBy> ended_by_named(std::string_view text) { return value_in(ends, text); }

std::optional<JudgedBy> judged_by_named(std::string_view text) {
  return value_in(judged_series, text);
}

std::string to_json(const FlowSummary& s) {
  Json json = common_part(s.run);
  json["time"] = s.time;
  json["ended_by"] = name(s.ended_by);
  json["state"] = name(s.state);
  json["judged_by"] = name(s.judged_by);
  json["held_back_by"] = s.held_back_by ? Json(name(*s.held_back_by)) : Json();
  json["mean_axial_velocity"] = measured(s.mean_axial_velocity);
  json["mass_flow_rate"] = measured(s.mass_flow_rate);
  json["transient_end"] = s.transient_end;
  json["independent_samples"] = s.independent_samples;
  json["granular_temperature"] = s.granular_temperature;
  json["fluctuations"] = fluctuations(s.fluctuations);
  json["structure_factor"] = structure_factor(s.structure_factor);
  json["profiles"] = {{"core", zone(s.core)}, {"wall_layers", zone(s.wall_layers)}};
  json["balance"] = balance(s.balance);
  json["grain_contact_rate"] = measured(s.grain_contact_rate);
  json["braking_force"] = braking_force(s.braking_force);
  json["wall_pressure"] = by_wall(s.wall_pressure.left, s.wall_pressure.right);
  json["energy"] = {
      {"initial", s.energy.initial},           {"kinetic", s.energy.kinetic},
      {"rotational", s.energy.rotational},     {"elastic", s.energy.elastic},
      {"gravity_work", s.energy.gravity_work}, {"wall_work", s.energy.wall_work},
      {"normal_loss", s.energy.normal_loss},   {"friction_loss", s.energy.friction_loss},
      {"residual", s.energy.residual}};
  json["wall_visits"] = wall_visits(s.wall_visits);
  json["validity"] = validity(s);
  return text_of(json);
}

std::string to_json(const CurveSummary& s) {
  Json json = common_part(s.run);
  Json curve = Json::array();
  for (const CurvePoint& p : s.curve)
    curve.push_back({{"v_x", p.v_x},
                     {"v_y", p.v_y},
                     {"dv_x", p.dv_x},
                     {"dv_y", p.dv_y},
                     {"contacts", p.contacts},
                     {"contact_time", p.contact_time},
                     {"max_overlap", p.max_overlap},
                     {"passed", p.passed},
                     {"stuck", p.stuck},
                     {"cut_short", p.cut_short},
                     {"brake_failure_fraction", p.brake_failure_fraction},
                     {"verdict", name(p.verdict)},
                     {"cause", p.cause}});
  json["curve"] = curve;
  json["lines"] = Json::array();
  for (const CurveLine& line : s.lines)
    json["lines"].push_back({{"v_x", line.v_x},
                             {"largest_dv_y", line.largest_dv_y},
                             {"largest_at", line.largest_at},
                             {"brake_fails_at", line.brake_fails.at},
                             {"brake_fails_within", line.brake_fails.within},
                             {"two_contacts_at", line.two_contacts.at},
                             {"two_contacts_within", line.two_contacts.within}});
  return text_of(json);
}

std::string to_json(const ColumnSummary& s) {
  Json json = common_part(s.run);
  json["t_col"] = s.t_col;
  json["rigid"] = {{"restitution", s.rigid.restitution},
                   {"rebound", s.rigid.rebound},
                   {"collisions", s.rigid.collisions},
                   {"collapsed", s.rigid.collapsed}};
  Json column = Json::array();
  for (const ColumnPoint& p : s.column)
    column.push_back({{"gap_ratio", p.gap_ratio},
                      {"gap", p.gap},
                      {"restitution", p.restitution},
                      {"rebound", p.rebound},
                      {"detachment", p.detachment},
                      {"contacts", p.contacts},
                      {"contact_time", p.contact_time},
                      {"max_overlap", p.max_overlap},
                      {"verdict", name(p.verdict)}});
  json["column"] = column;
  return text_of(json);
}

}  // namespace riesel::io
