// summary.json read back: reading and writing again gives the same text, and what does not fit is
// refused.
#include "io/summary_reader.hpp"

#include "io/build_info.hpp"
#include "io/file_error.hpp"
#include "tests/io/file_fixture.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace riesel;
using namespace riesel::io;
using namespace file_fixture;

namespace {

/// Each number is another one, some are not known.
FlowSummary special_summary() {
  FlowSummary s;
  s.run = {.scenario = "periodic_tube",
           .grains = 1403,
           .steps = 123456789012,
           .state_hash = 0x00ffee0012345678U,
           .wall_seconds = 1.0 / 3.0,
           .particle_steps_per_second = 2e7 / 3.0,
           .threads = 3};
  s.time = 0.1;
  s.transient_end = 0.02;
  s.state = SteadyVerdict::drifting;
  s.ended_by = EndedBy::at_most;
  s.judged_by = JudgedBy::granular_temperature;
  s.held_back_by = JudgedBy::mean_vy;
  s.mass_flow_rate = {0.0123, 0.0004};
  s.mean_axial_velocity = {.value = 10.0 / 7.0, .error = std::nan("")};
  s.independent_samples = 11.5;
  s.granular_temperature = 1e-300;
  s.fluctuations = {.sigma_vx = {0.1, 0.01},
                    .sigma_vy = {0.2, 0.02},
                    .granular_temperature = {0.3, std::nan("")}};
  s.structure_factor = {Measured{1.5, 0.5}, {1.6, 0.6}, {1.7, 0.7}, {std::nan(""), std::nan("")}};
  s.core = {.area_fraction = {0.5, 0.01},
            .mean_axial_velocity = {0.6, 0.02},
            .temperature_x = {0.7, 0.03},
            .temperature_y = {0.8, std::nan("")},
            .stress_xx = {0.9, 0.04},
            .stress_yy = {-0.1, 0.05},
            .stress_xy = {-0.2, 0.07},
            .shear_rate = {-0.5, 0.11},
            .mean_spin = {-0.3, 0.08},
            .rotational_temperature = {0.4, 0.09}};
  s.wall_layers.area_fraction = {0.2, 0.06};
  s.balance = {.n_dot = {1.1, 0.1}, .dv_y = {1.2, 0.2}, .n_dot_dv_y = {1.3, 0.3}, .gravity = -0.0};
  s.grain_contact_rate = {77.0, 0.7};
  s.braking_force = {.left = {1.4, 0.4}, .right = Measured{1.5, std::nan("")}, .weight = 2.9};
  s.wall_pressure = {.left = {1.6, 0.5}, .right = Measured{1.7, 0.6}};
  s.energy = {.initial = 1.0 / 9.0,
              .kinetic = 2.1,
              .rotational = 2.6,
              .elastic = 2.2,
              .gravity_work = -2.3,
              .wall_work = -2.7,
              .normal_loss = 2.4,
              .friction_loss = 2.5,
              .residual = -1e-12 / 3.0};
  s.wall_visits = {.visits = 44.0,
                   .contacts = {3.1, 0.31},
                   .dv_y = {3.2, 0.32},
                   .dv_x = {3.3, 0.33},
                   .entry_rate = {3.4, 0.34},
                   .entry_slip = {3.5, 0.35},
                   .of_contacts = {1, 2, 3, 4, 5, 6, 7, 8}};
  s.validity = {.verdict = judge({.max_overlap_ratio = 0.3,
                                  .brake_failure_fraction = 0.05,
                                  .passages_per_visit = 2.5,
                                  .wall_speed_ratio = 0.7,
                                  .pulling_fraction = std::nan(""),
                                  .steps_per_contact = 12.0,
                                  .energy_error_ratio = 1e-4,
                                  .limits_exceeded = 0.0,
                                  .contact_rate_times_t_col = 0.01}),
                .v_crit = 2.2,
                .t_col_grains = 5e-5 / 3.0,
                .t_col_walls = std::nan(""),
                .friction_failure_fraction = 0.125,
                .warnings = {"limits.speed is exceeded"}};
  return s;
}

std::string complaint(const fs::path& path) {
  return message_of<FileError>([&] { read_summary(path); });
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const auto at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), replacement);
}

}  // namespace

TEST_CASE("A summary that is read back and written again is the same text") {
  const ScratchDirectory directory;
  const auto path = directory / summary_name;
  const auto text = to_json(special_summary());
  overwrite(path, text);
  const auto summary = std::get<FlowSummary>(read_summary(path));
  CHECK(to_json(summary) == text);
  CHECK(std::isnan(summary.mean_axial_velocity.error));
  CHECK(summary.validity.warnings == std::vector<std::string>{"limits.speed is exceeded"});
  CHECK(summary.validity.verdict.findings.at(2).verdict == Validity::unphysical);
  CHECK(summary.validity.verdict.findings.at(0).meaning == "grains sink deep into each other");
}

TEST_CASE("A summary that does not fit is refused with a reason") {
  const ScratchDirectory directory;
  const auto path = directory / summary_name;
  const auto text = to_json(special_summary());
  CHECK(complaint(path).find("cannot be opened") != std::string::npos);
  for (const auto& damaged :
       {std::string("[]"), with(text, "\"gravity_work\"", "\"work\""),
        with(text, "\"grains\": 1403", "\"grains\": \"many\""),
        with(text, "\"verdict\": \"unphysical\"", "\"verdict\": \"good\""),
        with(text, "\"state\": \"drifting\"", "\"state\": 3"),
        with(text, "\"name\": \"max_overlap_ratio\"", "\"name\": \"overlap\"")}) {
    overwrite(path, damaged);
    INFO(damaged.substr(0, 200));
    CHECK(complaint(path).find("is damaged") != std::string::npos);
  }
}

TEST_CASE("A word that this program does not know is named") {
  const ScratchDirectory directory;
  const auto path = directory / summary_name;
  const auto text = to_json(special_summary());
  for (const auto& [word, told] : std::vector<std::pair<std::string, std::string>>{
           {"\"state\": \"drifting\"", "there is no state odd"},
           {"\"ended_by\": \"at_most\"", "there is no ended_by odd"},
           {"\"judged_by\": \"granular_temperature\"", "there is no judged_by odd"},
           {"\"verdict\": \"unphysical\"", "there is no verdict odd"}}) {
    overwrite(path, with(text, word, word.substr(0, word.find(' ')) + " \"odd\""));
    CHECK(complaint(path).find("is damaged (" + told + ")") != std::string::npos);
  }
}

TEST_CASE("Ends of runs and series that judge them have one name each") {
  for (const auto ended_by : {EndedBy::duration, EndedBy::precision, EndedBy::at_most})
    CHECK(ended_by_named(name(ended_by)) == ended_by);
  for (const auto judged_by : {JudgedBy::mean_vy, JudgedBy::granular_temperature})
    CHECK(judged_by_named(name(judged_by)) == judged_by);
  CHECK_FALSE(ended_by_named("mean_vy"));
  CHECK_FALSE(judged_by_named("duration"));
}

TEST_CASE("A summary of another format is refused, and told which riesel wrote it") {
  const ScratchDirectory directory;
  const auto path = directory / summary_name;
  const auto text = to_json(special_summary());
  const auto format = "\"format\": " + std::to_string(summary_format) + ",";
  for (const auto& [replacement, told] : std::vector<std::pair<std::string, std::string>>{
           {"", "has format 1"}, {"\"format\": 99,", "has format 99"}}) {
    overwrite(path, with(text, format, replacement));
    CHECK(complaint(path).find(told) != std::string::npos);
    CHECK(complaint(path).find("use riesel " + std::string(build_info().version))
          != std::string::npos);
  }
}

TEST_CASE("Verdicts and thresholds are those of the file, words are those of this program") {
  const ScratchDirectory directory;
  const auto path = directory / summary_name;
  // Neither these thresholds nor those of this program come to these verdicts.
  FlowSummary kept = special_summary();
  kept.validity.verdict.verdict = Validity::valid;
  kept.validity.verdict.findings.at(0).suspect = 0.4;
  kept.validity.verdict.findings[0].verdict = Validity::unphysical;
  overwrite(path, to_json(kept));
  const auto summary = std::get<FlowSummary>(read_summary(path));
  CHECK(summary.validity.verdict.verdict == Validity::valid);
  const Finding& finding = summary.validity.verdict.findings.at(0);
  CHECK(finding.value == 0.3);
  CHECK(finding.suspect == 0.4);
  CHECK(finding.verdict == Validity::unphysical);
  CHECK(finding.meaning == "grains sink deep into each other");
}

TEST_CASE("A curve that is read back and written again is the same text") {
  const ScratchDirectory directory;
  const auto path = directory / summary_name;
  CurveSummary curve;
  curve.run.scenario = "wall_array";
  curve.curve = {{.v_x = 0.1,
                  .v_y = 1.0 / 3.0,
                  .dv_x = std::nan(""),
                  .dv_y = -0.5,
                  .contacts = 1.5,
                  .contact_time = 1e-5,
                  .max_overlap = 2e-6,
                  .passed = 3,
                  .stuck = 4,
                  .cut_short = 0.25,
                  .brake_failure_fraction = 0.125,
                  .verdict = Validity::suspect,
                  .cause = "max_overlap_ratio"},
                 {.v_x = 0.2, .verdict = Validity::unphysical}};
  overwrite(path, to_json(curve));
  CHECK(to_json(std::get<CurveSummary>(read_summary(path))) == to_json(curve));
}

TEST_CASE("A column that is read back and written again is the same text") {
  const ScratchDirectory directory;
  const auto path = directory / summary_name;
  ColumnSummary summary;
  summary.run.scenario = "bead_column";
  summary.t_col = 7e-5;
  summary.rigid = {.restitution = 0.25, .rebound = 0.125, .collisions = 25, .collapsed = false};
  summary.column = {{.gap_ratio = 1.0 / 3.0,
                     .gap = 1e-6,
                     .restitution = 0.5,
                     .rebound = 0.375,
                     .detachment = 0.2,
                     .contacts = 17.0,
                     .contact_time = 1e-4,
                     .max_overlap = 2e-6,
                     .verdict = Validity::suspect},
                    {.restitution = std::nan(""), .verdict = Validity::unphysical}};
  overwrite(path, to_json(summary));
  CHECK(to_json(std::get<ColumnSummary>(read_summary(path))) == to_json(summary));
}

TEST_CASE("A summary that was cut short is told") {
  const ScratchDirectory directory;
  const auto path = directory / summary_name;
  const auto whole = to_json(special_summary());
  for (const auto& part : {std::string(), whole.substr(0, whole.size() / 2)}) {
    overwrite(path, part);
    CHECK(complaint(path)
          == path.string() + ": is not complete JSON; restore the file, or make the run again");
  }
}

TEST_CASE("A whole summary of an older version that lacks a value is not called damaged") {
  const ScratchDirectory directory;
  const auto path = directory / summary_name;
  const auto lacking = with(to_json(special_summary()), "\"wall_work\"", "\"wall_work_of_later\"");
  overwrite(path, lacking);
  CHECK(complaint(path).find("is damaged (key 'wall_work' not found)") != std::string::npos);
  const auto version = "\"version\": \"" + std::string(build_info().version) + "\"";
  overwrite(path, with(lacking, version, "\"version\": \"0.4.0\""));
  CHECK(complaint(path)
        == path.string()
               + ": does not fit this version of riesel (key 'wall_work' not found); use riesel "
                 "0.4.0, which wrote it, or make the run again");
}
