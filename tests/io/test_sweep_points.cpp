// Sweeps: which points a sweep file makes, and that their names depend on what they are alone.
#include "io/sweep_file.hpp"
#include "io/sweep_points.hpp"
#include "tests/io/file_fixture.hpp"
#include "tests/io/settings_fixture.hpp"

#include <cmath>
#include <fstream>
#include <set>

using namespace settings_fixture;

namespace {

/// The fixture's tube, which can be continued.
const SettingsTables& sweep_tables() {
  static const SettingsTables all = [] {
    auto with_start = tables();
    with_start.at("tube").push_back({.key = "start.kind",
                                     .kind = Kind::choice,
                                     .fallback = "fresh",
                                     .choices = {"fresh", "continued", "file"},
                                     .doc = "Start."});
    with_start.at("tube").push_back({.key = "start.from",
                                     .kind = Kind::path,
                                     .required = true,
                                     .doc = "Run.",
                                     .only_when = When{"start.kind", {"continued"}}});
    with_start.at("tube").push_back({.key = "start.from",
                                     .kind = Kind::path,
                                     .required = true,
                                     .doc = "Grains.",
                                     .only_when = When{"start.kind", {"file"}},
                                     .names_content = true});
    with_start.at("tube").push_back({.key = "tube.obstacles",
                                     .kind = Kind::path,
                                     .doc = "Obstacles, if there are any.",
                                     .names_content = true});
    with_start.at("tube").push_back({.key = "start.speed",
                                     .unit = "m/s",
                                     .fallback = "1 m/s",
                                     .doc = "Speed.",
                                     .only_when = When{"start.kind", {"fresh"}}});
    return with_start;
  }();
  return all;
}

const std::string base =
    "base: {scenario: tube, tube: {width: 20 mm}, contact: {stiffness: 2000}}\n";

std::vector<SweepPoint> points(const std::string& rest, const std::string& first = base) {
  return expand(read_sweep_text(first + rest, "s.yaml", sweep_tables()), sweep_tables());
}

std::vector<double> values_of(const std::vector<SweepPoint>& all, const std::string& key) {
  std::vector<double> values;
  for (const auto& point : all) values.push_back(point.settings.number(key));
  return values;
}

std::vector<std::int64_t> seeds_of(const std::vector<SweepPoint>& all) {
  std::vector<std::int64_t> seeds;
  for (const auto& point : all) seeds.push_back(point.settings.integer("seed"));
  return seeds;
}

std::set<std::string> names_of_points(const std::vector<SweepPoint>& all) {
  std::set<std::string> names;
  for (const auto& point : all) names.insert(point.name);
  return names;
}

std::string name(const std::string& rest, const std::string& first = base) {
  return points(rest, first).at(0).name;
}

std::string error_of(const std::string& rest, const std::string& first = base) {
  return file_fixture::message_of<SettingsError>([&] { (void)points(rest, first); });
}

}  // namespace

TEST_CASE("a sweep without axes is its base") {
  const auto all = points("");
  REQUIRE(all.size() == 1);
  CHECK(all[0].settings.number("tube.width") == 0.02);
  CHECK(all[0].yaml == all[0].settings.effective_yaml());
  CHECK(all[0].name.size() == 16);
  CHECK_FALSE(all[0].parent);
  CHECK(all[0].branch.empty());
}

TEST_CASE("axes make a grid, the last one fastest, then branches, then seeds") {
  const auto all = points("axes: {gravity: [1, 2], tube.width: [3, 4 m]}\n"
                          "branches: {a: {start.speed: 5}, b: {}}\nseeds: [7, 8]\n");
  REQUIRE(all.size() == 16);
  CHECK(std::vector(all.begin(), all.begin() + 2).at(1).settings.integer("seed") == 8);
  const auto widths = values_of(all, "tube.width");
  CHECK(std::vector(widths.begin(), widths.begin() + 8)
        == std::vector<double>{3, 3, 3, 3, 4, 4, 4, 4});
  CHECK(values_of(all, "gravity")[7] == 1.0);
  CHECK(values_of(all, "gravity")[8] == 2.0);
  CHECK(all[1].branch == "a");
  CHECK(all[2].branch == "b");
  CHECK(values_of(all, "start.speed")[1] == 5.0);
  CHECK(values_of(all, "start.speed")[2] == 1.0);
}

TEST_CASE("keys of one axis go together") {
  const auto all = points("axes: [{gravity: [1, 2, 3], tube.width: [4, 5, 6]}]\n");
  CHECK(values_of(all, "gravity") == std::vector<double>{1, 2, 3});
  CHECK(values_of(all, "tube.width") == std::vector<double>{4, 5, 6});
}

TEST_CASE("a range is spread out in SI units, with both ends") {
  const auto all = points("axes: {tube.width: {from: 1 mm, to: 1 m, points: 4, spacing: log}}\n");
  const auto widths = values_of(all, "tube.width");
  REQUIRE(widths.size() == 4);
  CHECK(widths.front() == 1e-3);
  CHECK(widths.back() == 1.0);
  CHECK(std::abs(widths[1] - 0.01) < 1e-15);
}

TEST_CASE("the unit of a range may depend on another setting") {
  const std::string range = "axes: {contact.stiffness: {from: 1, to: 3, points: 2, spacing: "
                            "linear}}\n";
  CHECK(values_of(points(range), "contact.stiffness") == std::vector<double>{1, 3});
  const std::string hertz = "set: {contact.law: hertz, contact.damping: 1}\n";
  CHECK(values_of(points(hertz + range), "contact.stiffness") == std::vector<double>{1, 3});
  CHECK(error_of(hertz + "axes: {contact.stiffness: {from: 1 N/m, to: 3, points: 2, spacing: log}}")
            .find("leave the unit out")
        != std::string::npos);
}

TEST_CASE("a number of seeds stands for as many from 1 on") {
  CHECK(seeds_of(points("seeds: 3\n")) == std::vector<std::int64_t>{1, 2, 3});
  CHECK(seeds_of(points("seeds: [9, 4]\n")) == std::vector<std::int64_t>{9, 4});
}

TEST_CASE("the name of a point does not depend on how or where it is written") {
  const auto expected = name("set: {tube.width: 10 mm, gravity: 10}\n");
  CHECK(name("set: {tube.width: 0.01}\n") == expected);
  CHECK(name("axes: {tube.width: [1 cm]}\n") == expected);
  CHECK(name("branches: {x: {tube.width: 1 cm}}\n") == expected);
  CHECK(name("seeds: 1\nset: {tube.width: 1 cm}\n") == expected);
  CHECK(name("", "base: {tube: {width: 1 cm}, scenario: tube, contact: {stiffness: 2 kN/m}}\n")
        == expected);
  const std::string one = "axes: {gravity: [1, 2], tube.width: [3, 4]}\nseeds: [1, 2]\n";
  const std::string other = "seeds: [2, 1]\naxes: {tube.width: [4, 3], gravity: [2, 1]}\n";
  CHECK(names_of_points(points(one)) == names_of_points(points(other)));
  CHECK(names_of_points(points(one)).size() == 8);
}

TEST_CASE("the name of a point depends on what its results depend on, and on nothing else") {
  const auto expected = name("");
  for (const char* idle : {"run.threads: 2", "run.stepping: plain"}) {
    CHECK(name(std::string("set: {") + idle + "}\n") == expected);
  }
  for (const char* key : {"seed: 2", "gravity: 9.999999999999998", "contact.friction: 0.4",
                          "run.steps_per_collision: 51", "start.speed: 2"}) {
    CHECK(name(std::string("set: {") + key + "}\n") != expected);
  }
}

TEST_CASE("the name of a point depends on what stands in a file, not on where that is") {
  const file_fixture::ScratchDirectory directory;
  const auto name_with = [&](const char* file, const char* content) {
    std::ofstream(directory / file) << content;
    return name("set: {start.kind: file, start.from: " + (directory / file).string() + "}\n");
  };
  const auto expected = name_with("a.csv", "1\n");
  CHECK(name_with("b.csv", "1\n") == expected);
  CHECK(name_with("a.csv", "2\n") != expected);
  // That it cannot be read is for the run to say.
  CHECK(name("set: {start.kind: file, start.from: none.csv}\n") != expected);
}

TEST_CASE("the name of a point does not depend on how the names of its files sort") {
  const file_fixture::ScratchDirectory directory;
  const auto name_with = [&](const char* grains, const char* obstacles) {
    std::ofstream(directory / grains) << "1\n";
    std::ofstream(directory / obstacles) << "2\n";
    return name("set: {start.kind: file, start.from: " + (directory / grains).string()
                + ", tube.obstacles: " + (directory / obstacles).string() + "}\n");
  };
  const auto expected = name_with("a.csv", "b.csv");
  CHECK(name_with("d.csv", "c.csv") == expected);
  CHECK(name_with("b.csv", "a.csv") == expected);
}

TEST_CASE("what stands in a file that may be left out counts where it is given") {
  const file_fixture::ScratchDirectory directory;
  const auto name_with = [&](const char* content) {
    std::ofstream(directory / "a.csv") << content;
    return name("set: {tube.obstacles: " + (directory / "a.csv").string() + "}\n");
  };
  const auto expected = name_with("1\n");
  CHECK(name_with("2\n") != expected);
  CHECK(name("") != expected);
}

TEST_CASE("a continuation goes forward and back, each point from the one before") {
  const auto all =
      points("axes: {gravity: [1, 2, 3], tube.width: [7, 8]}\nseeds: 2\ncontinue_along: gravity\n");
  REQUIRE(all.size() == 20);
  for (std::size_t chain = 0; chain < all.size(); chain += 5) {
    const std::vector<SweepPoint> part(all.begin() + static_cast<std::ptrdiff_t>(chain),
                                       all.begin() + static_cast<std::ptrdiff_t>(chain + 5));
    CHECK(values_of(part, "gravity") == std::vector<double>{1, 2, 3, 2, 1});
    CHECK_FALSE(part[0].parent);
    for (std::size_t i = 1; i < 5; ++i) {
      CHECK(part[i].parent == chain + i - 1);
      CHECK(part[i].leg == (i < 3 ? "forward" : "backward"));
      const auto file =
          Settings::from_text(part[i].yaml, "/sweep/points/x/point.yaml", sweep_tables());
      CHECK(file.text("start.kind") == "continued");
      CHECK(file.text("start.from") == "/sweep/points/" + part[i - 1].name);
      CHECK(file.number("gravity") == part[i].settings.number("gravity"));
    }
  }
  CHECK(names_of_points(all).size() == 20);
}

TEST_CASE("the first point of a chain is the ordinary point, the others depend on their past") {
  const std::string axis = "axes: {gravity: [1, 2]}\n";
  const auto grid = points(axis);
  const auto chain = points(axis + "continue_along: gravity\n");
  const auto longer = points("axes: {gravity: [1, 2, 3]}\ncontinue_along: gravity\n");
  const auto other = points("axes: {gravity: [1.5, 2]}\ncontinue_along: gravity\n");
  const auto fast = points("set: {start.speed: 9}\n" + axis + "continue_along: gravity\n");
  CHECK(chain[0].name == grid[0].name);
  CHECK(chain[1].name != grid[1].name);
  CHECK(chain[1].name == longer[1].name);
  CHECK(chain[1].name != other[1].name);
  CHECK(chain[1].name != fast[1].name);
}

TEST_CASE("a base that is a path is relative to the sweep file") {
  const file_fixture::ScratchDirectory directory;
  std::filesystem::create_directory(directory / "sub");
  std::ofstream(directory / "tube.yaml")
      << "scenario: tube\ntube: {width: 20 mm}\ncontact: {stiffness: 2000}\n";
  std::ofstream(directory / "sub/s.yaml") << "base: ../tube.yaml\n";
  const auto sweep = read_sweep_file(directory / "sub/s.yaml", sweep_tables());
  CHECK(expand(sweep, sweep_tables()).at(0).name == name(""));
}

TEST_CASE("the points of a chain count, there and back") {
  const std::string chain = "axes: {gravity: {from: 1, to: 2, points: 5001, spacing: linear}}\n";
  const std::string too_many = "s.yaml:1:1: axes: the sweep has more than 10000 points";
  CHECK(error_of(chain + "continue_along: gravity\n").starts_with(too_many));
  CHECK(error_of(chain + "seeds: 2\n").starts_with(too_many));
  CHECK(points(chain).size() == 5001);
}

TEST_CASE("what cannot be a sweep is refused with its place") {
  CHECK(error_of("axes: {tube.width: [1 m, 1 kg]}\n").starts_with("s.yaml:2:26: tube.width: "));
  CHECK(error_of("axes: {gravity: [-1, 1]}\nbranches: {a: {tube.width: x}}\n")
            .starts_with("s.yaml:3:28: tube.width: "));
  CHECK(error_of("branches: {a: {gravity: 1}}\naxes: {gravity: [1]}\n")
            .starts_with("s.yaml:2:16: gravity: is set twice"));
  CHECK(error_of("continue_along: gravity\n").starts_with("s.yaml:2:17: continue_along: "));
  CHECK(error_of("branches: [1, 2]\n")
            .starts_with("s.yaml:2:11: branches: expected named sets of overrides, got a list"));
  CHECK(error_of("axes: {scenario: [tube, wall]}\n")
            .starts_with("s.yaml:2:8: scenario: cannot be changed by a sweep"));
  CHECK(error_of("set: {scenario: wall}\n")
            .starts_with("s.yaml:2:7: scenario: cannot be changed by a sweep"));
  CHECK(error_of("", "base: [tube.yaml]\n")
            .starts_with("s.yaml:1:7: base: expected the path of a settings file, or settings"));
  CHECK(error_of("axes: {impact.starts: [1, 2]}\ncontinue_along: impact.starts\n",
                 "base: {scenario: wall}\n")
            .starts_with("s.yaml:3:17: continue_along: the runs of the scenario wall cannot"));
}
