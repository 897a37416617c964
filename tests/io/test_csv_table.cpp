// Tables of quantities: what is read, and where it is said that something cannot be.
#include "io/csv_table.hpp"
#include "tests/catch.hpp"
#include "tests/message_of.hpp"

#include <numbers>

using namespace riesel::io;

namespace {

const std::vector<CsvColumn> columns = {{.name = "x", .unit = "m"},
                                        {.name = "vx", .unit = "m/s"},
                                        {.name = "mass", .unit = "kg", .required = false}};

std::string complaint(const std::string& text) {
  return riesel::message_of<SettingsError>([&] { (void)parse_csv(text, "t.csv", columns); });
}

void check_begins(const std::string& message, const std::string& beginning) {
  CAPTURE(message, beginning);
  CHECK(message.starts_with(beginning));
}

}  // namespace

TEST_CASE("a table is read in SI units, in any order of its columns") {
  const CsvTable table =
      parse_csv("# of a run\nvx (cm/s), x (mm)\n\n 100 ,0.66\r\n-2e1,-3\n", "t.csv", columns);
  REQUIRE(table.rows() == 2);
  CHECK(table.value(0, "x") == 0.66e-3);
  CHECK(table.value(0, "vx") == 1.0);
  CHECK(table.value(1, "x") == -3e-3);
  CHECK(table.value(1, "vx") == -0.2);
  CHECK_FALSE(table.has("mass"));
  CHECK(table.line(0) == 4);
}

TEST_CASE("a column without a unit is in SI units, and a byte order mark is no part of a name") {
  const CsvTable table = parse_csv("\xEF\xBB\xBFx,vx,mass (mg)\n1,2,3", "t.csv", columns);
  CHECK(table.value(0, "x") == 1.0);
  CHECK(table.value(0, "mass") == 3e-6);
}

TEST_CASE("a heading may have the other name of a unit") {
  const std::vector<CsvColumn> spin = {{.name = "spin", .unit = "rad/s", .also = "1/s"}};
  for (const char* heading : {"spin", "spin (1/s)", "spin (rad/s)"})
    CHECK(parse_csv(std::string(heading) + "\n3\n", "t.csv", spin).value(0, "spin") == 3.0);
  CHECK(parse_csv("spin (rad/ms)\n3\n", "t.csv", spin).value(0, "spin") == 3000.0);
  const double turn = 2.0 * std::numbers::pi;
  CHECK(parse_csv("spin (rpm)\n60\n", "t.csv", spin).value(0, "spin") == Approx(turn));
  CHECK(parse_csv("spin (degrees/s)\n360\n", "t.csv", spin).value(0, "spin") == Approx(turn));
  const auto hertz =
      riesel::message_of<SettingsError>([&] { (void)parse_csv("spin (Hz)\n3\n", "t.csv", spin); });
  check_begins(hertz, "t.csv:1:1: spin: 'Hz' is not a unit for this column;");
}

TEST_CASE("what is wrong with a table is told with its place and a remedy") {
  check_begins(complaint(""), "t.csv: has no rows; give a line with the columns x, vx, mass");
  check_begins(complaint("x,vx\n"), "t.csv: has no rows;");
  check_begins(complaint("x (mm)\n1\n"), "t.csv:1:1: vx: is missing; add the column 'vx (m/s)'");
  check_begins(complaint("x,vx, y\n1,2,3\n"), "t.csv:1:7: y: unknown column;");
  check_begins(complaint("# x,vx\n5.2e-3,0\n"),
               "t.csv:2:1: 5.2e-3: unknown column; the columns are x, vx, mass (if any); the first "
               "line that does not begin with # must name them");
  check_begins(complaint("x,vx,x\n1,2,3\n"), "t.csv:1:6: x: appears twice;");
  check_begins(complaint("x (mm,vx\n1,2\n"),
               "t.csv:1:1: x: has a unit without a closing parenthesis;");
  check_begins(complaint("x (s),vx\n1,2\n"), "t.csv:1:1: x: 's' is not a unit for this column;");
  check_begins(complaint("\"x\",vx\n1,2\n"), "t.csv:1:1: has quotation marks in the first line;");
  check_begins(complaint("x,vx\n1,2\n\n3\n"), "t.csv:4:1: has 1 cell, but the first line has 2;");
  check_begins(complaint("x,vx\n1,2,3\n"), "t.csv:2:5: has 3 cells, but the first line has 2;");
  check_begins(complaint("x,vx\n1,1e999\n"),
               "t.csv:2:3: vx: '1e999' is outside the range of a double; write a number within it");
  for (const std::string bad : {"nan", "inf", "", "1 mm", "0x10", "one", "1e999"}) {
    CAPTURE(bad);
    check_begins(complaint("x,vx\n1, " + bad + "\n"), "t.csv:2:");
    CHECK(complaint("x,vx\n1, " + bad + "\n").find(": vx: ") != std::string::npos);
  }
}

TEST_CASE("places are counted in characters, as editors do") {
  check_begins(complaint("x (\xC2\xB5m),vx,y\n1,2,3\n"), "t.csv:1:11: y: unknown column;");
  check_begins(complaint("x,vx\n1, \xC3\xA9\xC3\xA9 \n"), "t.csv:2:4: vx: ");
  check_begins(complaint("x,vx\n\xC3\xA9,2,3\n"), "t.csv:2:5: has 3 cells,");
}

TEST_CASE("a value can be rejected at its place") {
  const CsvTable table = parse_csv("x,vx\n1,2\n3,  4\n", "t.csv", columns);
  CHECK(
      riesel::message_of<SettingsError>([&] { table.reject(1, "vx", "is too fast", "slow down"); })
      == "t.csv:3:5: vx: is too fast; slow down");
}
