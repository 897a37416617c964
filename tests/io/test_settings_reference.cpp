// The reference page holds every row, each in one line of a Markdown table.
#include "io/settings_reference.hpp"
#include "tests/io/settings_fixture.hpp"

#include <numbers>

using namespace settings_fixture;

namespace {

bool holds_line(const std::string& page, const std::string& line) {
  return page.find("\n" + line + "\n") != std::string::npos;
}

}  // namespace

TEST_CASE("the reference page describes the settings") {
  const auto page = settings_reference(tables());
  CHECK(holds_line(page, "## All scenarios"));
  CHECK(holds_line(page, "## Scenario `tube`"));
  CHECK(holds_line(page,
                   "| `contact.stiffness` | N/m, above 0 | required | Stiffness k_N of the linear "
                   "law. Only when contact.law is linear. |"));
  CHECK(holds_line(page,
                   "| `grains.polydispersity` | number, at least 0 and below 1 | `5 %` | Relative "
                   "half width of the distribution of radii. |"));
  CHECK(holds_line(page,
                   "| `impact.speed` | list of m/s, at least 0 | `[0.1, 0.3 m/s]` | Speeds. |"));
  CHECK(holds_line(page, "| `output.pictures` | `some`, `none` | `some` | Whether to draw. |"));
  CHECK(holds_line(page, "| `output.title` | text |  | Title. |"));
}

TEST_CASE("common settings stand in the reference page once") {
  const auto page = settings_reference(tables());
  for (const auto& row : common_settings()) {
    REQUIRE(page.find("| `" + row.key + "` |") != std::string::npos);
    CHECK(page.find("## Scenario") > page.rfind("| `" + row.key + "` |"));
  }
}

TEST_CASE("rows that several scenarios share stand in the reference page once") {
  const auto row = [](const std::string& key) { return Setting{.key = key, .doc = key + "."}; };
  const auto page = settings_reference({{"a", {row("w"), row("x"), row("y"), row("z"), row("s")}},
                                        {"b", {row("x"), row("y"), row("z"), row("s")}},
                                        {"c", {row("s"), row("t")}},
                                        {"d", {row("s"), row("t")}}});
  const auto section = [&](const std::string& title) {
    const auto begin = page.find("## " + title + "\n");
    REQUIRE(begin != std::string::npos);
    const auto section_text = page.substr(begin, page.find("\n## ", begin) - begin);
    std::string keys;
    for (const char key : {'s', 't', 'w', 'x', 'y', 'z'})
      if (section_text.find(std::string("| `") + key + "` |") != std::string::npos) keys += key;
    return keys;
  };
  CHECK(section("Scenarios `a`, `b`") == "xyz");
  CHECK(section("Scenario `a`") == "sw");  // a single row is not worth a section of several
  CHECK(section("Scenario `b`") == "s");
  CHECK(section("Scenario `c`") == "st");
  CHECK(section("Scenario `d`") == "st");
}

TEST_CASE("ranges of angles are in degrees") {
  constexpr double right_angle = std::numbers::pi / 2.0;
  const auto page = settings_reference(
      {{"x", {{.key = "a", .unit = "rad", .range = between(-right_angle, right_angle)}}}});
  CHECK(page.find("| rad, from -90 to 90 degrees |") != std::string::npos);
}

TEST_CASE("bars within a cell are escaped") {
  const SettingsTables one = {{"x", {{.key = "a.b", .unit = "m", .doc = "Either | or."}}}};
  CHECK(settings_reference(one).find("| Either \\| or. |") != std::string::npos);
}
