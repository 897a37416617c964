// effective.yaml records all that a problem depends on: read again it gives the same problem, bit
// by bit. For every file that ships and for whatever else settings can ask for.
#include "tests/scenarios/scenario_fixture.hpp"

#include <algorithm>
#include <filesystem>

using namespace scenario_fixture;

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> shipped_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(SHIPPED_SCENARIOS)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool same(const NormalLaw& a, const NormalLaw& b) {
  if (a.index() != b.index()) return false;
  const double overlap = 1e-5, rate = 0.3, reduced_mass = 1e-6;
  const auto force = [&](const auto& law) {
    return law.elastic(overlap) + law.damping(overlap, rate, reduced_mass);
  };
  return std::visit(force, a) == std::visit(force, b);
}

bool same(const SlipLaw& a, const SlipLaw& b) {
  if (a.index() != b.index()) return false;
  const auto force = [](const auto& law) {
    return law.force({.limit = 1e9,
                      .present_limit = 1e9,
                      .slip = 0.1,
                      .half_step_slip = 0.1,
                      .spring = 1e-6,
                      .weight = 1.0,
                      .reduced_mass = 1e-6,
                      .slip_mass = 1e-6,
                      .per_dt = 1e6});
  };
  return std::visit(force, a) == std::visit(force, b);
}

void check_same(const ContactModel& a, const ContactModel& b) {
  CHECK(same(a.normal, b.normal));
  CHECK(same(a.slip, b.slip));
  CHECK(a.friction == b.friction);
  CHECK((a.attraction == b.attraction));
  CHECK(a.rolling_friction == b.rolling_friction);
}

void check_same(const scenarios::Flow& a, const scenarios::Flow& b) {
  CHECK(state_hash(a.state) == state_hash(b.state));
  REQUIRE(a.state.walls.size() == b.state.walls.size());
  for (std::size_t i = 0; i < a.state.walls.size(); ++i) {
    CHECK(a.state.walls[i].line == b.state.walls[i].line);
    CHECK(a.state.walls[i].radius == b.state.walls[i].radius);
    CHECK(a.state.walls[i].count == b.state.walls[i].count);
  }
  check_same(a.model, b.model);
}

void check_same(const scenarios::ImpactCurve& a, const scenarios::ImpactCurve& b) {
  const auto numbers = [](const ImpactSetup& s) {
    return std::vector{s.grain_radius, s.grain_mass, s.wall_grain_radius,
                       s.wall_spacing, s.inertia,    s.collision_time};
  };
  CHECK(numbers(a.setup) == numbers(b.setup));
  check_same(a.setup.model, b.setup.model);
  CHECK(a.points.size() == b.points.size());
  REQUIRE(a.impacts.size() == b.impacts.size());
  for (std::size_t i = 0; i < a.impacts.size(); ++i) {
    const Impact &p = a.impacts[i], &q = b.impacts[i];
    CHECK(std::vector{p.x, p.y, p.v_x, p.v_y, p.time_step}
          == std::vector{q.x, q.y, q.v_x, q.v_y, q.time_step});
  }
}

void check_same(const scenarios::ColumnCurve& a, const scenarios::ColumnCurve& b) {
  const auto numbers = [](const ColumnSetup& s) {
    return std::vector{static_cast<double>(s.beads),
                       s.bead_radius,
                       s.bead_mass,
                       s.velocity,
                       s.collision_time,
                       s.time_step};
  };
  CHECK(numbers(a.setup) == numbers(b.setup));
  check_same(a.setup.model, b.setup.model);
  CHECK(a.gap_ratios == b.gap_ratios);
}

void check_comes_back(const io::Settings& settings) {
  const std::string effective = settings.effective_yaml();
  CAPTURE(effective);
  const auto again = read(effective);
  CHECK(again.effective_yaml() == effective);
  std::visit(
      [&](const auto& first) {
        check_same(first, std::get<std::decay_t<decltype(first)>>(scenarios::problem_of(again)));
      },
      scenarios::problem_of(settings));
}

}  // namespace

TEST_CASE("every scenario ships with a file of its name, which is accepted and comes back") {
  const auto files = shipped_files();
  CHECK(files.size() == scenarios::all().size());
  for (const fs::path& file : files) {
    CAPTURE(file);
    const auto settings = io::Settings::from_file(file, scenarios::settings_tables());
    CHECK(settings.scenario() == file.stem());
    check_comes_back(settings);
  }
}

TEST_CASE("tubes of all kinds come back from their effective settings") {
  const Overrides overrides = GENERATE(
      Overrides{}, Overrides{"contact.law=power", "contact.stiffness=1e5", "contact.damping=0.1"},
      Overrides{"contact.law=hertz", "contact.stiffness=3.3e5", "contact.damping=1.7"},
      Overrides{"contact.slip=viscous", "contact.slip_damping=1e5 1/s", "contact.attraction=clip"},
      Overrides{"contact.slip=spring", "contact.slip_stiffness=700 N/m", "grains.rotation=disc"},
      Overrides{"contact.slip=spring", "contact.slip_stiffness=9 kN/m",
                "contact.slip_damping=2e3 1/s", "grains.rotation=sphere",
                "contact.rolling_friction=0.05"},
      Overrides{"grains.size_distribution=truncated_normal", "grains.polydispersity=7 %"},
      Overrides{"grains.size_distribution=bidisperse", "grains.size_ratio=2.5",
                "grains.large_fraction=0.3"},
      Overrides{"grains.diameter=1.1 mm", "grains.mass=1.3 mg", "grains.area_fraction=0.123"},
      Overrides{"grains.area_fraction=0.8", "seed=77"},
      Overrides{"gravity=9.81 m/s^2", "start.axial_velocity=-0.1 m/s", "run.threads=3"});
  check_comes_back(read(tube_yaml, overrides));
}

TEST_CASE("a restitution comes back from the effective settings as the same damping") {
  const std::string of = GENERATE("wall", "grains");
  check_comes_back(
      read(tube_of_restitution_yaml, {"contact.restitution=0.83", "contact.restitution_of=" + of}));
}

TEST_CASE("impacts of all kinds come back from their effective settings") {
  check_comes_back(read(single_yaml, {"impact.height=0.7 mm", "impact.axial_velocity=3 m/s"}));
  check_comes_back(read(single_yaml, {"grains.rotation=sphere", "contact.slip=spring",
                                      "contact.slip_stiffness=40 kN/m"}));
  check_comes_back(read(array_yaml, {"wall.spacing=0.9 mm", "impact.starts=7",
                                     "impact.normal_velocity=[10 cm/s, 0.7]"}));
}
