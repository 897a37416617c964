// Every way to get a setting wrong: each is told at its place, with what was expected and what to
// do about it.
#include "tests/io/settings_fixture.hpp"

#include <algorithm>

using namespace settings_fixture;

namespace {

const std::string tube = "scenario: tube\ntube: {width: 20 mm}\ncontact: {stiffness: 2000}\n";

}  // namespace

TEST_CASE("wrong dimensions and units") {
  CHECK(
      tube_error("grains: {diameter: 3 kg}")
      == "f.yaml:4:20: grains.diameter: expected a length such as '0.66 mm' or a number in m, got "
         "'3 kg'; replace 'kg' with a unit that converts to m");
  CHECK(
      tube_error("gravity: 10 m/s")
      == "f.yaml:4:10: gravity: expected an acceleration such as '10 m/s^2' or a number in m/s^2, "
         "got '10 m/s'; replace 'm/s' with a unit that converts to m/s^2");
  CHECK(
      tube_error("grains: {diameter: 3 foo}")
      == "f.yaml:4:20: grains.diameter: expected a length such as '0.66 mm' or a number in m, got "
         "'3 foo'; replace 'foo', which is not a known unit");
  CHECK(tube_error("run: {steps_per_collision: 50 m}")
        == "f.yaml:4:28: run.steps_per_collision: expected a pure number such as '0.05' or '5 %', "
           "got "
           "'50 m'; replace 'm' with %, or leave the unit out");
  CHECK(
      error("scenario: wall\ncontact: {law: hertz, stiffness: 2000 N/m}\n")
      == "f.yaml:2:34: contact.stiffness: expected an SI number such as '1.5', without a unit, got "
         "'2000 N/m'; leave the unit out");
}

TEST_CASE("columns count characters") {
  CHECK(tube_error("output: {title: 'müüüh', pictures: 5}")
        == "f.yaml:4:36: output.pictures: expected some or none, got '5'; choose one of them");
  CHECK(tube_error("grains: {diameter: 5 µs}").find("f.yaml:4:20: ") == 0);
}

TEST_CASE("malformed numbers") {
  const auto remedy_for = [](const std::string& value) {
    const auto message = tube_error("gravity: " + value);
    CHECK(message.find("f.yaml:4:10: gravity: expected an acceleration") == 0);
    return message.substr(message.rfind("; ") + 2);
  };
  CHECK(remedy_for("1,5") == "write a decimal point, and no separators of thousands");
  CHECK(remedy_for("1,000.5 m/s^2") == "write a decimal point, and no separators of thousands");
  CHECK(remedy_for("2_000") == "write the digits without separators");
  CHECK(remedy_for("2 000") == "write the digits without separators");
  CHECK(remedy_for("0x10") == "write a decimal number");
  CHECK(remedy_for("0o17") == "write a decimal number");
  CHECK(remedy_for("017") == "remove the leading zero: some programs read it as octal");
  CHECK(remedy_for("-00.5") == "remove the leading zero: some programs read it as octal");
  for (const std::string value : {".nan", ".inf", "-.INF", "nan", "inf", "-Infinity"}) {
    CHECK(remedy_for(value) == "give a finite number");
  }
  for (const std::string value : {"1e999", "-1e999", "1e-999", "1e-310", "1e308 km/s^2"}) {
    CHECK(remedy_for(value) == "give a value that a double-precision number can hold");
  }
  for (const std::string value : {"ten", "m/s^2", "yes", "--5", "+-5", "''", "$5"}) {
    CHECK(remedy_for(value) == "begin with the number, as in the example");
  }
  CHECK(remedy_for("1:30") == "replace ':30', which is not a known unit");
  CHECK(remedy_for("1.2.3") == "replace '.3', which is not a known unit");
  CHECK(remedy_for("[1]") == "give a single value");
  CHECK(remedy_for("{a: 1}") == "give a single value");
}

TEST_CASE("values out of range") {
  CHECK(tube_error("grains: {diameter: -1 mm}")
        == "f.yaml:4:20: grains.diameter: must be above 0 m, got '-1 mm'; give a value in this "
           "range");
  CHECK(tube_error("grains: {diameter: 0}").find("must be above 0 m, got '0'")
        != std::string::npos);
  CHECK(
      tube_error("grains: {polydispersity: 100 %}")
      == "f.yaml:4:26: grains.polydispersity: must be at least 0 and below 1, got '100 %'; give a "
         "value in this range");
  CHECK(tube_error("run: {steps_per_collision: 4.9}")
        == "f.yaml:4:28: run.steps_per_collision: must be at least 5, got '4.9'; give a value in "
           "this "
           "range");
  CHECK(tube_error("run: {threads: 0}")
        == "f.yaml:4:16: run.threads: must be from 1 to 1024, got '0'; give a value in this range");
  CHECK(tube_error("seed: -1")
        == "f.yaml:4:7: seed: must be at least 0, got '-1'; give a value in this range");
  CHECK(error("scenario: wall\ncontact: {stiffness: 1, restitution: 0}")
        == "f.yaml:2:38: contact.restitution: must be above 0 and at most 1, got '0'; give a value "
           "in "
           "this range");
}

TEST_CASE("malformed integers") {
  const std::string expected = "f.yaml:4:7: seed: expected an integer, got ";
  for (const std::string value : {"1.0", "1e4", "0x10", "five", "1 %", "2_0", ".inf", "+5", "''"}) {
    CAPTURE(value);
    CHECK(tube_error("seed: " + value)
          == expected + (value == "''" ? value : "'" + value + "'")
                 + "; write its decimal digits and nothing else");
  }
  CHECK(tube_error("seed: 017") == expected + "'017'; write 17");
  CHECK(tube_error("seed: -0") == expected + "'-0'; write 0");
  CHECK(tube_error("seed: 9223372036854775808")
        == expected + "'9223372036854775808'; it must fit into 64 bits");
  CHECK(tube_error("seed: [1]") == expected + "a list; give a single value");
  CHECK(tube_error("run: {threads: many}")
        == "f.yaml:4:16: run.threads: expected an integer or auto, got 'many'; write its decimal "
           "digits "
           "and nothing else");
}

TEST_CASE("wrong choices and texts") {
  CHECK(tube_error("run: {stepping: palin}")
        == "f.yaml:4:17: run.stepping: expected auto, plain or windows, got 'palin'; did you mean "
           "'plain'?");
  CHECK(tube_error("run: {stepping: Plain}").find("did you mean 'plain'?") != std::string::npos);
  CHECK(tube_error("run: {stepping: windmill}").find("; choose one of them") != std::string::npos);
  CHECK(tube_error("output: {title: ''}")
        == "f.yaml:4:17: output.title: expected a text, got ''; give a text");
}

TEST_CASE("long and many-lined values are quoted on one short line") {
  const auto message = tube_error("gravity: \"" + std::string(500, 'x') + "\"");
  CHECK(message.find("got '" + std::string(60, 'x') + "...'") != std::string::npos);
  CHECK(tube_error("gravity: \"a\\nb\"").find("got 'a b'") != std::string::npos);
  CHECK(tube_error("gravity: \"3 a\\nb\"").find("replace 'a b'") != std::string::npos);
  CHECK(tube_error("\"a\\nb\": 3").find("f.yaml:4:1: a b: unknown key; ") == 0);
}

TEST_CASE("missing values") {
  CHECK(tube_error("gravity:")
        == "f.yaml:4:1: gravity: has no value; give an acceleration such as '10 m/s^2' or a number "
           "in "
           "m/s^2, or remove the key");
  CHECK(tube_error("run: {threads: ~}").find("f.yaml:4:7: run.threads: has no value; ") == 0);
  CHECK(tube_error("run: {threads: null, stepping: auto}").find("f.yaml:4:7: run.threads: ") == 0);
  CHECK(error("scenario: tube\ncontact: {stiffness: 1}\ntube: {}\n")
        == "f.yaml:3:1: tube.width: is missing; give a length such as '0.66 mm' or a number in m");
  CHECK(error("scenario: tube\ncontact: {stiffness: 1}\n")
        == "f.yaml:1:1: tube.width: is missing; give a length such as '0.66 mm' or a number in m");
  CHECK(tube_error("grains: {diameter: 1}\nrun: {}").empty());
}

TEST_CASE("the scenario comes first") {
  CHECK(error("seed: 1\n")
        == "f.yaml:1:1: scenario: is missing; add 'scenario:' with tube or wall");
  CHECK(error("Scenario: tube\n")
        == "f.yaml:1:1: scenario: is missing; write 'scenario' instead of 'Scenario'");
  CHECK(error("seed: 1\nscenario: tub\n")
        == "f.yaml:2:11: scenario: expected tube or wall, got 'tub'; did you mean 'tube'?");
  CHECK(error("scenario: hourglass\n")
        == "f.yaml:1:11: scenario: expected tube or wall, got 'hourglass'; choose one of them");
  CHECK(error("scenario:\n")
        == "f.yaml:1:1: scenario: has no value; give tube or wall, or remove the key");
  CHECK(error("scenario: [tube]\n")
        == "f.yaml:1:11: scenario: expected tube or wall, got a list; give a single value");
}

TEST_CASE("unknown keys") {
  CHECK(tube_error("run: {thread: 2}")
        == "f.yaml:4:7: run.thread: unknown key; did you mean 'run.threads'?");
  CHECK(tube_error("run: {trheads: 2}").find("did you mean 'run.threads'?") != std::string::npos);
  CHECK(tube_error("grains: {diameter: 3,5}")
        == "f.yaml:4:22: grains.5: unknown key; a comma begins the next key; write a decimal "
           "point, as in 0.92");
  CHECK(tube_error("run: {threads:2}")
        == "f.yaml:4:7: run.threads:2: unknown key; put a space after the colon: 'threads: 2'");
  CHECK(tube_error("seeed: 2") == "f.yaml:4:1: seeed: unknown key; did you mean 'seed'?");
  CHECK(tube_error("Run: {}") == "f.yaml:4:1: Run: unknown key; did you mean 'run'?");
  CHECK(tube_error("run: {speed_of_light: 2}")
        == "f.yaml:4:7: run.speed_of_light: unknown key; the keys of run are steps_per_collision, "
           "threads or stepping");
  CHECK(
      tube_error("whatever: 2")
      == "f.yaml:4:1: whatever: unknown key; expected scenario, seed, contact, run, grains, tube, "
         "gravity or output");
  CHECK(tube_error(std::string(1000, 'x') + ": 2").find("unknown key; expected")
        != std::string::npos);
}

TEST_CASE("known keys in the wrong place") {
  CHECK(tube_error("run: {seed: 2}")
        == "f.yaml:4:7: run.seed: unknown key; 'seed' belongs at the top level, outside of any "
           "section");
  CHECK(tube_error("threads: 2")
        == "f.yaml:4:1: threads: unknown key; 'threads' belongs in the section run");
  CHECK(tube_error("grains: {friction: 2}")
        == "f.yaml:4:10: grains.friction: unknown key; 'friction' belongs in the section contact");
  CHECK(tube_error("grains: {fricton: 2}")
        == "f.yaml:4:10: grains.fricton: unknown key; did you mean 'contact.friction'?");
  CHECK(tube_error("impact: {starts: 3}")
        == "f.yaml:4:1: impact: unknown key; remove it: the scenario tube does not have it (only "
           "wall does)");
  CHECK(tube_error("run.threads: 2")
        == "f.yaml:4:1: run.threads: dotted keys are for --set only; write 'run: {threads: ...}'");
}

TEST_CASE("sections and values confused") {
  CHECK(tube_error("run: 5")
        == "f.yaml:4:6: run: expected a section with keys, got '5'; write 'run: "
           "{steps_per_collision: ...}'");
  CHECK(tube_error("run: [threads, 2]").find("f.yaml:4:6: run: expected a section") == 0);
  CHECK(tube_error("run:").find("f.yaml:4:1: run: expected a section with keys, got nothing") == 0);
}

TEST_CASE("settings without effect") {
  CHECK(
      error("scenario: wall\ncontact: {law: hertz, stiffness: 1, damping: 1, restitution: 0.5}\n")
      == "f.yaml:2:49: contact.restitution: has no effect when contact.law is hertz; remove it; it "
         "applies only when contact.law is linear");
  CHECK(error("scenario: wall\ncontact: {stiffness: 1, exponent_rate: 2}\n")
        == "f.yaml:2:25: contact.exponent_rate: has no effect when contact.law is linear; remove "
           "it; it "
           "applies only when contact.law is power");
  CHECK(error("scenario: wall\ncontact: {stiffness: 1, slip_damping: 2}\n")
        == "f.yaml:2:25: contact.slip_damping: has no effect when contact.slip is cap; remove it; "
           "it applies only when contact.slip is viscous or spring");
  // The file need not be changed for an override.
  const std::string linear = "scenario: wall\ncontact: {stiffness: 1, restitution: 0.5}\n";
  CHECK(error(linear, {"contact.law=hertz", "contact.damping=1"})
        == "f.yaml:2:25: contact.restitution: has no effect when contact.law is hertz; remove it, "
           "here by --set contact.restitution=; it applies only when contact.law is linear");
  CHECK(error(linear, {"contact.law=hertz", "contact.damping=1", "contact.restitution="}).empty());
}

TEST_CASE("settings that another one requires") {
  CHECK(error("scenario: wall\ncontact: {stiffness: 1, slip: viscous}\n")
        == "f.yaml:2:1: contact.slip_damping: is missing, as contact.slip is viscous; give a rate "
           "such "
           "as '1e4 1/s' or a number in 1/s");
  CHECK(error("scenario: wall\ncontact: {law: power, stiffness: 1}\n")
            .find("f.yaml:2:1: contact.damping: is missing, as contact.law is power or hertz; ")
        == 0);
}

TEST_CASE("mistakes beyond those that are told are mentioned") {
  std::string file = tube;
  const auto with_one_more = [&](int number) {
    file += "k" + std::to_string(number) + ": 1\n";
    return error(file);
  };
  std::string told;
  for (int i = 1; i <= 19; ++i) told = with_one_more(i);
  CHECK(std::count(told.begin(), told.end(), '\n') == 18);
  CHECK(told.find("more") == std::string::npos);
  for (int i = 20; i <= 21; ++i) {
    told = with_one_more(i);
    CHECK(std::count(told.begin(), told.end(), '\n') == 20);
    CHECK(told.ends_with("\n... and perhaps more: these are the first 20"));
  }
}

TEST_CASE("lists and ranges") {
  const std::string expected = "expected a velocity such as '0.5 m/s' or a number in m/s, ";
  CHECK(speed_error("[]")
        == "f.yaml:3:17: impact.speed: the list is empty; give at least one value");
  std::string many = "[1";
  for (int i = 0; i < 10'000; ++i) many += ", 1";
  CHECK(speed_error(many + "]")
        == "f.yaml:3:17: impact.speed: the list has 10001 values, at most 10000 are allowed; split "
           "it over several runs");
  CHECK(speed_error("[1, 2 kg]")
        == "f.yaml:3:21: impact.speed: " + expected
               + "got '2 kg'; replace 'kg' with a unit that converts to m/s");
  CHECK(speed_error("[1, [2]]")
        == "f.yaml:3:21: impact.speed: " + expected + "got a list; give a single value");
  CHECK(speed_error("[1, -2]").find("f.yaml:3:21: impact.speed: must be at least 0 m/s") == 0);
  CHECK(speed_error("[1, ]").empty());
  CHECK(speed_error("[1, ~]").find("got nothing; give a single value") != std::string::npos);
  CHECK(speed_error("fast").find(
            "f.yaml:3:17: impact.speed: expected a velocity such as '0.5 m/s' or "
            "a number in m/s, or a list of these, got 'fast'")
        == 0);

  CHECK(speed_error("{from: 1, to: 2, points: 3}")
        == "f.yaml:3:17: impact.speed.spacing: is missing; give log or linear");
  CHECK(speed_error("{from: 1, to: 2 kg, points: 3, spacing: log}")
        == "f.yaml:3:31: impact.speed.to: " + expected
               + "got '2 kg'; replace 'kg' with a unit that converts to m/s");
  CHECK(speed_error("{from: 1, to: 2, points: 1, spacing: log}")
        == "f.yaml:3:42: impact.speed.points: must be from 2 to 10000, got '1'; give a value in "
           "this "
           "range");
  CHECK(speed_error("{from: 1, to: 2, points: 3, spacing: liner}")
        == "f.yaml:3:54: impact.speed.spacing: expected log or linear, got 'liner'; did you mean "
           "'linear'?");
  CHECK(
      speed_error("{from: 0, to: 2, points: 3, spacing: log}")
      == "f.yaml:3:17: impact.speed: a logarithmic range needs both ends above 0; choose 'spacing: "
         "linear', or move the end");
  CHECK(speed_error("{from: 2, to: 2, points: 3, spacing: log}")
        == "f.yaml:3:17: impact.speed: from and to are equal; give the one value alone");
  CHECK(speed_error("{form: 1, to: 2, points: 3, spacing: log}")
        == "f.yaml:3:18: impact.speed.form: unknown key; did you mean 'from'?");
  CHECK(speed_error("{from: 1, to: 2, count: 3, spacing: log}")
        == "f.yaml:3:34: impact.speed.count: unknown key; the keys of a range are from, to, points "
           "and "
           "spacing");
}

TEST_CASE("overrides are checked like the file, and errors name them") {
  CHECK(error(tube, {"contact.stiffness=3 kg"})
        == "--set contact.stiffness=3 kg: contact.stiffness: expected a stiffness such as '2000 "
           "N/m' or "
           "a number in N/m, got '3 kg'; replace 'kg' with a unit that converts to N/m");
  CHECK(error(tube, {"run.thread=3"})
        == "--set run.thread=3: run.thread: unknown key; did you mean 'run.threads'?");
  CHECK(error(tube, {"scenario=tubs"}).find("--set scenario=tubs: scenario: expected tube or wall")
        == 0);
  CHECK(error(tube, {"seed"}) == "--set seed: expected key=value; write for instance --set seed=2");
  CHECK(error(tube, {"=5"}).find("--set =5: expected key=value") == 0);
  CHECK(error(tube, {"seed="}).find("--set seed=: seed: has no value; ") == 0);
  CHECK(error(tube, {"run={threads: 2}"})
        == "--set run={threads: 2}: run: is a section and has no value of its own; override its "
           "keys, "
           "as in --set run.steps_per_collision=...");
  CHECK(error(tube, {"contact="}).find("contact.stiffness: is missing") != std::string::npos);
  CHECK(error(tube, {"seed=[1"}).find("--set seed=[1: not valid YAML (") == 0);
  CHECK(error(tube, {"seed=*x"}).find("--set seed=*x: not valid YAML (") == 0);
  CHECK(error(tube, {"contact.slip=viscous"})
            .find("f.yaml:3:1: contact.slip_damping: is missing, as contact.slip is viscous")
        == 0);
  CHECK(error(tube, {"contact.exponent_rate=2"})
            .find("--set contact.exponent_rate=2: contact.exponent_rate: has no effect")
        == 0);
}
