// From the section `contact` to the laws of the engine.
#include "engine/closed_forms.hpp"
#include "tests/message_of.hpp"
#include "tests/scenarios/scenario_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace scenario_fixture;
using Catch::Matchers::WithinRel;

namespace {

constexpr double k_n = 2000.0, mass = 1e-6;  // N/m, kg

/// 1/s, gamma_N for the restitution e: from ln e = -gamma t_col / 2 and eq. (4) of the paper.
double damping_for(double e, double reduced_mass) {
  const double ratio = std::log(e) / std::numbers::pi;
  return 2.0 * std::sqrt(k_n / reduced_mass * ratio * ratio / (1.0 + ratio * ratio));
}

double damping_of(const ContactModel& model) { return std::get<LinearLaw>(model.normal).gamma_n; }

ContactModel tube_model(const Overrides& overrides) { return tube(overrides).model; }

}  // namespace

TEST_CASE("restitution is that of a grain and the wall, unless it is said to be that of grains") {
  const std::string e = GENERATE("0.3", "0.7", "0.97", "1");
  CAPTURE(e);
  const auto damping = [&](const Overrides& of) {
    Overrides overrides = {"contact.restitution=" + e};
    overrides.insert(overrides.end(), of.begin(), of.end());
    return damping_of(flow(tube_of_restitution_yaml, overrides).model);
  };
  const double wall = damping_for(std::stod(e), mass);
  const double grains = damping_for(std::stod(e), 0.5 * mass);
  CHECK_THAT(damping({}), WithinRel(wall, 1e-12));
  CHECK_THAT(damping({"contact.restitution_of=wall"}), WithinRel(wall, 1e-12));
  CHECK_THAT(damping({"contact.restitution_of=grains"}), WithinRel(grains, 1e-12));
}

TEST_CASE("restitution of all is that of every pair, whatever its masses, also without pull") {
  const std::string e = GENERATE("0.3", "0.7", "0.97", "1");
  const std::string attraction = GENERATE("keep", "clip");
  const ContactModel model =
      flow(tube_of_restitution_yaml, {"contact.restitution=" + e, "contact.restitution_of=all",
                                      "contact.attraction=" + attraction})
          .model;
  CHECK(std::get<EqualRestitutionLaw>(model.normal).at(mass).k_n == k_n);
  for (const double reduced_mass : {1e-3 * mass, 0.5 * mass, mass, 40.0 * mass})
    CHECK_THAT(linear_contact(model.normal, reduced_mass, model.attraction).value().restitution(),
               WithinRel(std::stod(e), 1e-12));
}

TEST_CASE("near critical damping the time step is that of twice a contact without damping") {
  const auto steps_per_period = [](const char* restitution) {  // of half a period without damping
    const auto problem =
        flow(tube_of_restitution_yaml,
             {"contact.restitution_of=all", "contact.restitution=" + std::string(restitution)});
    const double lightest = std::ranges::min(problem.state.grains.mass);
    return std::numbers::pi * std::sqrt(0.5 * lightest / k_n) / problem.state.time_step;
  };
  const double pi = std::numbers::pi;
  CHECK_THAT(steps_per_period("1e-9"), WithinRel(25.0, 1e-9));
  CHECK_THAT(steps_per_period("0.004"), WithinRel(25.0, 1e-9));
  for (const char* e : {"0.005", "0.5"})  // eq. (4): t_col is this much longer than half a period
    CHECK_THAT(steps_per_period(e),
               WithinRel(50.0 * pi / std::hypot(pi, std::log(std::stod(e))), 1e-9));
}

TEST_CASE("restitution of all is refused where damping is given") {
  check_mentions(complaint(tube_yaml, {"contact.restitution_of=all"}),
                 {"contact.restitution_of:", "contact.damping", "contact.restitution instead"});
}

TEST_CASE("the restitution is that of contacts as they are, also if they may not pull") {
  const std::string e = GENERATE("0.2", "0.7", "0.97");
  const ContactModel model =
      flow(tube_of_restitution_yaml, {"contact.restitution=" + e, "contact.attraction=clip"}).model;
  const LinearContact wall{k_n, damping_of(model), mass, Attraction::clip};
  CHECK_THAT(wall.restitution(), WithinRel(std::stod(e), 1e-12));
}

TEST_CASE("a restitution that contacts which may not pull cannot have is refused") {
  check_mentions(
      complaint(tube_of_restitution_yaml, {"contact.restitution=0.1", "contact.attraction=clip"}),
      {"contact.restitution:", "critical damping", "above 0.1353", "contact.attraction: keep"});
}

TEST_CASE("a law from outside cannot take the name of one of the house") {
  for (const char* name : {"linear", "power", "hertz"}) {
    const auto told = message_of<std::logic_error>(
        [&] { scenarios::add(scenarios::Law{.name = name, .own_settings = {}, .make = nullptr}); });
    CHECK(told == "'" + std::string(name) + "' is a law of riesel already");
  }
}

TEST_CASE("a scenario from outside needs a name of its own, and its function") {
  const auto told = [](const char* name, bool complete) {
    return message_of<std::logic_error>([&] {
      scenarios::add(scenarios::Scenario{
          .name = name,
          .summary = {},
          .own_settings = {},
          .prepare = complete ? scenarios::named("periodic_tube").prepare : nullptr});
    });
  };
  CHECK(told("cooling", false) == "'cooling' lacks its function prepare");
  scenarios::settings_tables();
  CHECK(told("cooling", true) == "'cooling' is added too late");
}

TEST_CASE("the paper's damping of 1e4 1/s is a restitution of 0.70 at the wall") {
  const LinearContact wall = {k_n, damping_of(tube().model), mass};
  CHECK_THAT(wall.restitution(), WithinRel(0.7023, 1e-4));
  CHECK_THAT(wall.collision_time(), WithinRel(7.07e-5, 1e-3));
}

TEST_CASE("damping and restitution exclude each other, and one of them is needed") {
  check_mentions(complaint(tube_yaml, {"contact.restitution=0.9"}),
                 {"contact.restitution:", "contact.damping", "remove one"});
  const std::string neither = R"(
scenario: periodic_tube
contact: {stiffness: 2000 N/m}
run: {duration: 1 s}
)";
  check_mentions(complaint(neither),
                 {"test.yaml:3:1:", "is missing", "contact.damping or contact.restitution"});
}

TEST_CASE("a contact so damped that grains do not rebound is refused in every scenario") {
  const double critical = 2.0 * std::sqrt(k_n / mass);  // of a grain and the wall
  const std::string above = "contact.damping=" + std::to_string(1.01 * critical);
  const std::string below = "contact.damping=" + std::to_string(0.99 * critical);
  for (const std::string& yaml : {single_yaml, array_yaml}) {
    check_mentions(complaint(yaml, {above}), {"contact.damping:", "do not rebound", "below"});
    CHECK(complaint(yaml, {below}) == "accepted");
  }
  check_mentions(complaint(tube_yaml, {"contact.damping=1e6"}),
                 {"contact.damping:", "do not rebound", "below"});
  check_mentions(complaint(tube_yaml, {"contact.damping=1e6", "contact.attraction=clip"}),
                 {"contact.damping:", "critical damping", "not offered", "below"});
}

TEST_CASE("each law of the contact is chosen by its name") {
  const std::string hertz = R"(
scenario: periodic_tube
contact: {law: hertz, stiffness: 5e5, damping: 3.3}
run: {duration: 1 s}
)";
  const auto law = std::get<HertzKuwabaraKonoLaw>(flow(hertz).model.normal);
  CHECK(law.k == 5e5);
  CHECK(law.gamma == 3.3);

  const auto power =
      std::get<PowerLaw>(flow(hertz, {"contact.law=power", "contact.exponent_elastic=1.2",
                                      "contact.exponent_overlap=0.3", "contact.exponent_rate=1.1"})
                             .model.normal);
  CHECK(power.alpha == 1.2);
  CHECK(power.beta == 0.3);
  CHECK(power.g == 1.1);
}

TEST_CASE("friction, slip and attraction are as chosen") {
  const ContactModel model = tube_model({});
  CHECK(model.friction == 0.5);
  CHECK(model.attraction == Attraction::keep);
  CHECK(std::holds_alternative<CappedSlip>(model.slip));

  CHECK(tube_model({"contact.friction=0"}).friction == 0.0);
  CHECK(tube_model({"contact.attraction=clip"}).attraction == Attraction::clip);
  CHECK(std::holds_alternative<LiteralSlip>(tube_model({"contact.slip=literal"}).slip));
  const ContactModel viscous = tube_model({"contact.slip=viscous", "contact.slip_damping=1e5 1/s"});
  CHECK(std::get<ViscousSlip>(viscous.slip).gamma_t == 1e5);
  const auto spring =
      std::get<SpringSlip>(tube_model({"contact.slip=spring", "contact.slip_stiffness=570 N/m",
                                       "contact.slip_damping=100 1/s"})
                               .slip);
  CHECK(spring.k_t == 570.0);
  CHECK(spring.gamma_t == 100.0);
}

TEST_CASE("grains rotate as discs or spheres, and resist rolling, as chosen") {
  const auto of = [](const std::string& rotation) {
    return tube({"grains.rotation=" + rotation, "contact.rolling_friction=0.02"});
  };
  CHECK(tube().state.grains.inertia == 0.0);
  CHECK(tube().model.rolling_friction == 0.0);
  CHECK(of("disc").state.grains.inertia == 0.5);
  CHECK(of("sphere").state.grains.inertia == 0.4);
  for (const char* rotation : {"disc", "sphere"})
    CHECK(of(rotation).model.rolling_friction == 0.02);
}

TEST_CASE("under a nonlinear law the time step is that of the impact speed set") {
  const std::string hertz = R"(
scenario: single_wall_grain
contact: {law: hertz, stiffness: 5e5, damping: 0, impact_speed: 2 m/s}
)";
  const double expected = elastic_collision_time(ElasticLine{5e5, 1.5}, mass, 2.0);
  CHECK_THAT(curve(hertz).setup.collision_time, WithinRel(expected, 1e-12));
}
