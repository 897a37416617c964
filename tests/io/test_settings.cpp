// Settings: what a correct file yields, and that effective.yaml yields the same bits again.
#include "tests/io/settings_fixture.hpp"
#include "tests/scratch_directory.hpp"

#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

using namespace settings_fixture;

namespace {

const std::string tube = "scenario: tube\ncontact: {stiffness: 2 kN/m}\ntube: {width: 20 mm}\n";
const std::string wall = "scenario: wall\ncontact: {stiffness: 2000}\n";

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

TEST_CASE("values come in SI units, given or by default") {
  const auto settings = read(tube + "seed: 7\noutput: {title: 'a: b'}\n");
  CHECK(settings.scenario() == "tube");
  CHECK(settings.integer("seed") == 7);
  CHECK(settings.number("contact.stiffness") == 2000.0);
  CHECK(settings.number("tube.width") == 0.02);
  CHECK(settings.number("grains.diameter") == 1e-3);
  CHECK(settings.number("grains.polydispersity") == 0.05);
  CHECK(settings.number("gravity") == 10.0);
  CHECK(settings.text("contact.law") == "linear");
  CHECK(settings.text("output.title") == "a: b");
  CHECK(settings.text("output.pictures") == "some");
  CHECK_FALSE(settings.integer_or_auto("run.threads"));
  CHECK(read(tube + "run: {threads: 4}").integer_or_auto("run.threads") == 4);
}

TEST_CASE("has and given tell defaults from the user's values") {
  const auto settings = read(tube);
  CHECK(settings.given("tube.width"));
  CHECK(settings.has("gravity"));
  CHECK_FALSE(settings.given("gravity"));
  CHECK_FALSE(settings.has("contact.restitution"));
  CHECK_FALSE(settings.has("output.title"));
}

TEST_CASE("JSON is YAML too, and so are quoted quantities") {
  const auto settings = read(R"({"scenario": "tube", "seed": 3, "tube": {"width": "20 mm"},
    "contact": {"stiffness": 2e3, "law": "linear"}, "output": {"pictures": "none"}})");
  CHECK(settings.number("tube.width") == 0.02);
  CHECK(settings.integer("seed") == 3);
  CHECK(settings.text("output.pictures") == "none");
}

TEST_CASE("byte order mark, Windows line ends, comments and a document start are no obstacle") {
  const auto settings =
      read("\xEF\xBB\xBF# tube\r\n---\r\nscenario: tube\r\ntube:\r\n  width: 20 mm  # wide\r\n"
           "contact:\r\n  stiffness: 2000 N/m\r\n...\r\n");
  CHECK(settings.number("tube.width") == 0.02);
}

TEST_CASE("lists of quantities, single ones and ranges") {
  const auto speeds = [](const std::string& value) {
    return read(wall + "impact: {speed: " + value + "}").numbers("impact.speed");
  };
  CHECK(read(wall).numbers("impact.speed") == std::vector<double>{0.1, 0.3});
  CHECK(speeds("20 cm/s") == std::vector<double>{0.2});
  CHECK(speeds("[1, 2 cm/s, 0]") == std::vector<double>{1.0, 0.02, 0.0});
  CHECK(speeds("{from: 1, to: 3, points: 5, spacing: linear}")
        == std::vector<double>{1.0, 1.5, 2.0, 2.5, 3.0});

  const auto spread = speeds("{from: 0.1 m/s, to: 40 m/s, points: 60, spacing: log}");
  REQUIRE(spread.size() == 60);
  CHECK(spread.front() == 0.1);
  CHECK(spread.back() == 40.0);
  for (std::size_t i = 1; i < spread.size(); ++i) {
    CHECK(spread[i] / spread[i - 1] == Approx(std::pow(400.0, 1.0 / 59.0)));
  }
  CHECK(speeds("{from: 3, to: 1, points: 2, spacing: log}") == std::vector<double>{3.0, 1.0});
}

TEST_CASE("rows depend on the law") {
  const std::string start = "scenario: tube\ntube: {width: 1}\n";
  const auto hertz = read(start + "contact: {law: hertz, stiffness: 1e7, damping: 3}");
  CHECK(hertz.number("contact.stiffness") == 1e7);
  CHECK(hertz.number("contact.impact_speed") == 1.0);
  CHECK_FALSE(hertz.has("contact.restitution_of"));
  CHECK_FALSE(hertz.has("contact.exponent_rate"));
  const auto power = read(start + "contact: {law: power, stiffness: 1e7, damping: 3}");
  CHECK(power.number("contact.exponent_elastic") == 1.5);
  CHECK(power.number("contact.exponent_overlap") == 0.5);
  CHECK(power.number("contact.exponent_rate") == 1.0);
  CHECK_FALSE(read(tube).has("contact.impact_speed"));
}

TEST_CASE("overrides replace and add values, the last one wins") {
  const auto settings = read(tube, {"tube.width=3 cm", "run.threads=2", "seed=5", "seed=6"});
  CHECK(settings.number("tube.width") == 0.03);
  CHECK(settings.integer_or_auto("run.threads") == 2);
  CHECK(settings.integer("seed") == 6);
  CHECK(settings.given("run.threads"));
  CHECK(settings.source_text() == tube);

  CHECK(read(wall, {"impact.speed=[1, 2]"}).numbers("impact.speed").size() == 2);
  CHECK(read(wall, {"impact.speed={from: 1, to: 2, points: 3, spacing: log}"})
            .numbers("impact.speed")
            .size()
        == 3);
  CHECK(read("contact: {stiffness: 1}", {"scenario=wall"}).scenario() == "wall");
  CHECK(read(tube, {"output.title=a=b"}).text("output.title") == "a=b");
}

TEST_CASE("an override hides what is wrong with the value in the file") {
  CHECK(read("scenario: wall\ncontact: {stiffness: 3 kg}", {"contact.stiffness=5"})
            .number("contact.stiffness")
        == 5.0);
}

TEST_CASE("effective.yaml lists every value in SI units") {
  CHECK(read(tube + "output: {title: hi}\n").effective_yaml()
        == R"(# Every setting of the run, defaults included, in SI units.
scenario: "tube"
seed: 1
gravity: 10.0  # m/s^2

contact:
  law: linear
  stiffness: 2000.0  # N/m
  restitution_of: wall
  attraction: keep
  friction: 0.5
  slip: cap

run:
  steps_per_collision: 50.0
  threads: auto
  stepping: auto

grains:
  rotation: none
  diameter: 0.001  # m
  polydispersity: 0.05

tube:
  width: 0.02  # m

output:
  title: "hi"
  pictures: some
)");
}

TEST_CASE("effective.yaml gives the same bits again") {
  const std::string odd = "[0.1, 0.30000000000000004, 1e-300, 2.2250738585072014e-308, 5e300, 0,"
                          " -0.0, 123456789.123456789, 1e22, 36 km/h]";
  const auto first = read(wall + "seed: 9223372036854775807\nimpact: {speed: " + odd + "}\n");
  const auto again = read(first.effective_yaml());
  CHECK(again.effective_yaml() == first.effective_yaml());
  CHECK(again.integer("seed") == 9223372036854775807);
  CHECK(again.number("contact.stiffness") == first.number("contact.stiffness"));
  const auto& a = first.numbers("impact.speed");
  const auto& b = again.numbers("impact.speed");
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(same_bits(a[i], b[i]));
}

TEST_CASE("effective.yaml of a range holds its values") {
  const auto first = read(wall + "impact: {speed: {from: 0.1, to: 40, points: 61, spacing: log}}");
  const auto again = read(first.effective_yaml());
  const auto& a = first.numbers("impact.speed");
  const auto& b = again.numbers("impact.speed");
  REQUIRE(b.size() == 61);
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(same_bits(a[i], b[i]));
}

TEST_CASE("effective.yaml of the longest list can be read again") {
  const auto first =
      read(wall + "impact: {speed: {from: 0.1, to: 40, points: 10000, spacing: log}}");
  CHECK(read(first.effective_yaml()).numbers("impact.speed").size() == 10'000);
}

TEST_CASE("texts of any content survive effective.yaml") {
  for (const std::string text :
       {"null", "~", "true", "a: b # c", "it's \\\"x\\\"", "ü\\n\\tz", "- 1", "a\\x7Fb"}) {
    const auto first = read(tube + "output: {title: \"" + text + "\"}\n");
    CHECK(read(first.effective_yaml()).text("output.title") == first.text("output.title"));
  }
}

TEST_CASE("a scenario rejects through the settings, at the key, the section or the file") {
  const auto settings = read(tube, {"run.threads=2"});
  const auto rejected = [&](const std::string& key) {
    return message_of<SettingsError>([&] { settings.reject(key, "is odd", "make it even"); });
  };
  CHECK(rejected("tube.width") == "f.yaml:3:8: tube.width: is odd; make it even");
  CHECK(rejected("contact.friction") == "f.yaml:2:1: contact.friction: is odd; make it even");
  CHECK(rejected("gravity") == "f.yaml:1:1: gravity: is odd; make it even");
  CHECK(rejected("run.threads") == "--set run.threads=2: run.threads: is odd; make it even");
}

TEST_CASE("an error carries its parts") {
  try {
    read(tube).reject("tube.width", "is odd", "make it even");
    FAIL("nothing is thrown");
  } catch (const SettingsError& caught) {
    CHECK(caught.place().source == "f.yaml");
    CHECK(caught.place().line == 3);
    CHECK(caught.place().column == 8);
    CHECK(caught.key() == "tube.width");
    CHECK(caught.problem() == "is odd");
    CHECK(caught.remedy() == "make it even");
  }
}

TEST_CASE("exactly one of several keys") {
  const std::vector<std::string> keys = {"contact.damping", "contact.restitution"};
  const auto message = [&](const std::string& contact) {
    const auto settings = read("scenario: wall\ncontact: {stiffness: 1" + contact + "}");
    return message_of<SettingsError>([&] { settings.require_exactly_one(keys); });
  };
  CHECK(message(", damping: 1").empty());
  CHECK(message(", restitution: 90 %").empty());
  CHECK(message("")
        == "f.yaml:2:1: contact.damping: is missing; give either contact.damping or "
           "contact.restitution");
  CHECK(
      message(", restitution: 0.9, damping: 1")
      == "f.yaml:2:25: contact.restitution: cannot be given together with contact.damping; remove "
         "one of the two");
}

TEST_CASE("asking for what the table does not hold is a mistake of the program") {
  const auto settings = read(tube);
  CHECK_THROWS_AS(settings.number("tube.girth"), std::logic_error);
  CHECK_THROWS_AS(settings.has("tube.girth"), std::logic_error);
  CHECK_THROWS_AS(settings.given("tube.girth"), std::logic_error);
  CHECK_THROWS_AS(settings.reject("tube.girth", "", ""), std::logic_error);
  CHECK_THROWS_AS(settings.integer("tube.width"), std::logic_error);
  CHECK_THROWS_AS(settings.number("contact.restitution"), std::logic_error);
}

TEST_CASE("tables that contradict themselves are mistakes of the program") {
  const auto verified = [](Setting row) {
    auto table = common_settings();
    table.push_back(std::move(row));
    verify_table(table);
  };
  CHECK_NOTHROW(verified({.key = "a.b", .doc = "Good."}));
  CHECK_THROWS_AS(verified({.key = "a.b", .doc = "No full stop"}), std::logic_error);
  CHECK_THROWS_AS(verified({.key = "a.b.c.d", .doc = "Deep."}), std::logic_error);
  CHECK_THROWS_AS(verified({.key = "seed", .doc = "Twice."}), std::logic_error);
  CHECK_THROWS_AS(verified({.key = "a", .fallback = "1", .required = true, .doc = "Both."}),
                  std::logic_error);
  CHECK_THROWS_AS(verified({.key = "a", .kind = Kind::choice, .doc = "No choices."}),
                  std::logic_error);
  CHECK_THROWS_AS(verified({.key = "a", .doc = "When.", .only_when = When{"seed", {"1"}}}),
                  std::logic_error);
  CHECK_THROWS_AS(verified({.key = "a", .doc = "When.", .only_when = When{"contact.law", {"x"}}}),
                  std::logic_error);
  const SettingsTables bad = {
      {"x", with_common({{.key = "a", .fallback = "3 kg m", .doc = "Bad."}})}};
  CHECK_THROWS_AS(Settings::from_text("scenario: x\ncontact: {stiffness: 1}", "f", bad),
                  std::logic_error);
}

TEST_CASE("the tables are sound") {
  for (const auto& [name, table] : tables()) CHECK_NOTHROW(verify_table(table));
}

TEST_CASE("files: missing, a directory, too large") {
  const riesel::ScratchDirectory folder;
  const auto message = [](const std::filesystem::path& file) {
    return message_of<SettingsError>([&] { (void)Settings::from_file(file, tables()); });
  };
  CHECK(message("/nowhere/f.yaml")
        == "/nowhere/f.yaml: cannot be opened (No such file or directory); check the path");
  CHECK(message(folder.path())
        == folder.path().string() + ": is a directory; give the path of a YAML file");

  const auto file = folder / "settings.yaml";
  std::ofstream(file) << tube;
  CHECK(Settings::from_file(file, tables()).source_text() == tube);
  std::ofstream(file) << std::string(1'000'001, '#');
  CHECK(message(file).find("is larger than 1000000 bytes") != std::string::npos);
}
