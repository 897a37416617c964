#include "io/summary.hpp"

#include "io/build_info.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace riesel::io {

namespace {

using Json = nlohmann::ordered_json;

Json common_part(const RunSummary& run) {
  return {{"scenario", run.scenario},
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

std::string text_of(const Json& json) { return json.dump(2) + "\n"; }

}  // namespace

std::string to_json(const FlowSummary& s) {
  Json json = common_part(s.run);
  json["time"] = s.time;
  json["state"] = s.state;
  json["mean_axial_velocity"] = {{"value", s.mean_axial_velocity.value},
                                 {"error", s.mean_axial_velocity.error}};
  json["transient_end"] = s.transient_end;
  json["independent_samples"] = s.independent_samples;
  json["granular_temperature"] = s.granular_temperature;
  json["balance"] = {{"n_dot", s.balance.n_dot},
                     {"dv_y", s.balance.dv_y},
                     {"n_dot_dv_y", s.balance.n_dot_dv_y},
                     {"gravity", s.balance.gravity}};
  json["energy"] = {
      {"initial", s.energy.initial},         {"kinetic", s.energy.kinetic},
      {"elastic", s.energy.elastic},         {"gravity_work", s.energy.gravity_work},
      {"normal_loss", s.energy.normal_loss}, {"friction_loss", s.energy.friction_loss},
      {"residual", s.energy.residual}};
  json["validity"] = {{"max_overlap_ratio", s.validity.max_overlap_ratio},
                      {"v_crit", s.validity.v_crit}};
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
                     {"stuck", p.stuck}});
  json["curve"] = curve;
  return text_of(json);
}

}  // namespace riesel::io
