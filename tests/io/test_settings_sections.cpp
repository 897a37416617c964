// Sections within sections, and overrides that take a key out.
#include "tests/io/settings_fixture.hpp"

#include <string>
#include <vector>

using namespace settings_fixture;

namespace {

const SettingsTables& deep() {
  static const Setting length = {.key = "flow.length", .unit = "m", .doc = "Length."};
  static const Setting limit = {.key = "flow.until.limit", .unit = "s", .doc = "Limit."};
  static const Setting title = {.key = "flow.until.title", .kind = Kind::text, .doc = "Title."};
  static const SettingsTables all = {{"tube", with_common({length, limit, title})}};
  return all;
}

const std::string beginning = "scenario: tube\ncontact: {stiffness: 2000}\n";

Settings read_deep(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return Settings::from_text(beginning + text, "f.yaml", deep(), overrides);
}

std::string deep_error(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return message_of<SettingsError>([&] { (void)read_deep(text, overrides); });
}

}  // namespace

TEST_CASE("the parts of a key with two dots") {
  CHECK(section_of("flow.until.limit") == "flow.until");
  CHECK(section_of("flow.until") == "flow");
  CHECK(section_of("flow").empty());
  CHECK(name_in_section("flow.until.limit") == "limit");
  CHECK(key_of("flow.until", "limit") == "flow.until.limit");
  CHECK(key_of("", "flow") == "flow");
  const SettingsTable& table = deep().at("tube");
  CHECK(has_section(table, "flow"));
  CHECK(has_section(table, "flow.until"));
  CHECK_FALSE(has_section(table, "flow.until.limit"));
  CHECK_FALSE(has_section(table, "flow.unt"));
  CHECK(names_of(table, "flow") == std::vector<std::string>{"length", "until"});
  CHECK(names_of(table, "flow.until") == std::vector<std::string>{"limit", "title"});
}

TEST_CASE("a section within a section is read, in all of YAML's styles") {
  for (const std::string text : {"flow: {until: {limit: 3 s, title: a}}\n",
                                 "flow:\n  until:\n    limit: 3 s\n    title: a\n"}) {
    const Settings settings = read_deep(text);
    CHECK(settings.number("flow.until.limit") == 3.0);
    CHECK(settings.text("flow.until.title") == "a");
    CHECK_FALSE(settings.has("flow.length"));
  }
}

TEST_CASE("the effective settings of a section within a section can be read again") {
  const Settings settings = read_deep("flow: {until: {limit: 3 s}, length: 2}\n");
  const std::string yaml = settings.effective_yaml();
  CHECK(yaml.find("\nflow:\n  length: 2.0  # m\n  until:\n    limit: 3.0  # s\n")
        != std::string::npos);
  const Settings again = Settings::from_text(yaml, "effective.yaml", deep());
  CHECK(again.effective_yaml() == yaml);
  CHECK(read_deep("").effective_yaml().find("flow") == std::string::npos);
}

TEST_CASE("a wrong key within a section of a section") {
  CHECK(deep_error("flow: {until: {limt: 3 s}}\n")
        == "f.yaml:3:16: flow.until.limt: unknown key; did you mean 'flow.until.limit'?");
  CHECK(deep_error("flow: {limit: 3 s}\n").find("'limit' belongs in the section flow.until")
        != std::string::npos);
  CHECK(deep_error("flow: {untl: {limit: 3 s}}\n").find("did you mean 'flow.until'?")
        != std::string::npos);
  CHECK(deep_error("flow: {until: 3 s}\n")
        == "f.yaml:3:15: flow.until: expected a section with keys, got '3 s'; write 'flow: {until: "
           "{limit: ...}}'");
  CHECK(deep_error("flow.until.limit: 3 s\n")
        == "f.yaml:3:1: flow.until.limit: dotted keys are for --set only; write 'flow: {until: "
           "{limit: ...}}'");
  CHECK(deep_error("flow: {until.limit: 3 s}\n").find("f.yaml:3:8: flow.until.limit: dotted keys")
        == 0);
  CHECK(deep_error("", {"flow.until=3"}).find("--set flow.until.limit=...") != std::string::npos);
}

TEST_CASE("what is missing in a section of a section is told at the innermost that is there") {
  const auto place = [](const std::string& text) {
    const auto message = message_of<SettingsError>(
        [&] { read_deep(text).reject("flow.until.title", "is missing", "give it"); });
    return message.substr(0, message.find(": "));
  };
  CHECK(place("flow: {until: {limit: 3 s}}\n") == "f.yaml:3:8");
  CHECK(place("flow: {length: 3}\n") == "f.yaml:3:1");
  CHECK(place("") == "f.yaml:1:1");
}

TEST_CASE("overrides reach into a section of a section") {
  const Settings settings = read_deep("flow: {until: {limit: 3 s}}\n", {"flow.until.limit=4 s"});
  CHECK(settings.number("flow.until.limit") == 4.0);
}

TEST_CASE("an override without a value takes the key out") {
  const std::string file = "flow: {length: 5, until: {limit: 3 s}}\n";
  CHECK_FALSE(read_deep(file, {"flow.until.limit="}).has("flow.until.limit"));
  CHECK_FALSE(read_deep(file, {"flow.length=null"}).has("flow.length"));
  CHECK(read_deep(file, {"flow.length=", "flow.length=6"}).number("flow.length") == 6.0);
  CHECK(read_deep("seed: 5\n", {"seed="}).integer("seed") == 1);  // the default
  CHECK(deep_error(file, {"contact.stiffness="}).find("contact.stiffness: is missing")
        != std::string::npos);
  CHECK(deep_error("", {"flow.length="}).find("--set flow.length=: flow.length: has no value")
        == 0);
}

TEST_CASE("a table in which a key is a section, too, is refused") {
  const SettingsTable table = {{.key = "flow.until.limit", .doc = "Limit."},
                               {.key = "flow.until", .doc = "Until."}};
  CHECK_THROWS_AS(verify_table(table), std::logic_error);
  CHECK_THROWS_AS(verify_table({table[1], table[0]}), std::logic_error);
}

TEST_CASE("a setting depends on what the setting that it depends on depends on") {
  SettingsTable rows = common_settings();
  rows.push_back({.key = "a.kind",
                  .kind = Kind::choice,
                  .fallback = "here",
                  .choices = {"here", "there"},
                  .doc = "Where."});
  rows.push_back({.key = "b.kind",
                  .kind = Kind::choice,
                  .fallback = "one",
                  .choices = {"one", "two"},
                  .doc = "Which.",
                  .only_when = When{"a.kind", {"here"}}});
  rows.push_back(
      {.key = "b.size", .required = true, .doc = "Size.", .only_when = When{"b.kind", {"two"}}});
  const SettingsTables tables = {{"x", rows}};
  const std::string file = "scenario: x\ncontact: {stiffness: 1, damping: 0}\n";
  const auto complaint = [&](const std::string& more) {
    return message_of<SettingsError>([&] { (void)Settings::from_text(file + more, "f", tables); });
  };
  CHECK(complaint("b: {kind: two, size: 3}").empty());
  CHECK(complaint("b: {kind: two}").find("b.size: is missing, as b.kind is two")
        != std::string::npos);
  CHECK(complaint("b: {size: 3}").find("b.size: has no effect when b.kind is one")
        != std::string::npos);
  CHECK(complaint("a: {kind: there}").empty());
  CHECK(complaint("a: {kind: there}\nb: {size: 3}")
            .find("b.size: has no effect when a.kind is there; remove it; it applies only when "
                  "a.kind is here")
        != std::string::npos);
  CHECK_FALSE(Settings::from_text(file + "a: {kind: there}", "f", tables).has("b.size"));
}
