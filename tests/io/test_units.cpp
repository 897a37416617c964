// Units: what passes becomes the same double as the SI numeral; what is no mere change of scale
// does not pass.
#include "io/units.hpp"
#include "tests/catch.hpp"
#include "tests/message_of.hpp"

#include <string>
#include <thread>
#include <vector>

using namespace riesel::io;

namespace {

double si(const std::string& text, const std::string& si_unit) {
  return value_in_si(split_quantity(text).value(), si_unit).value();
}

std::string remedy(const std::string& text, const std::string& si_unit) {
  return riesel::message_of<UnitError>(
      [&] { (void)value_in_si(split_quantity(text).value(), si_unit); });
}

}  // namespace

TEST_CASE("a quantity with a unit is the same double as its SI numeral") {
  CHECK(si("0.66 mm", "m") == 6.6e-4);
  CHECK(si("0.66mm", "m") == 0.66e-3);
  CHECK(si("1 mg", "kg") == 1e-6);
  CHECK(si("0.7 µm", "m") == 0.7e-6);  // micro sign
  CHECK(si("0.7 μm", "m") == 0.7e-6);  // Greek mu
  CHECK(si("0.7 um", "m") == 0.7e-6);
  CHECK(si("1e4 1/s", "1/s") == 1e4);
  CHECK(si("1e4 Hz", "1/s") == 1e4);
  CHECK(si("2 kN/mm", "N/m") == 2e6);
  CHECK(si("2.3 g/cm^3", "kg/m^3") == 2300.0);
  CHECK(si("981 cm s-2", "m/s^2") == 9.81);
  CHECK(si("9.81 m/s²", "m/s^2") == 9.81);
  CHECK(si("0.3e3 mm", "m") == 0.3);
  CHECK(si("7 %", "1") == 0.07);
  CHECK(si("2 min", "s") == 120.0);
  CHECK(si("36 km/h", "m/s") == Approx(10.0).epsilon(1e-15));
  CHECK(si("+5 mm", "m") == 5e-3);
  CHECK(si("-5 mm", "m") == -5e-3);
  CHECK(si(" 5 ", "m") == 5.0);
}

TEST_CASE("every decimal in millimetres is the double of its SI numeral") {
  for (int i = 1; i < 5000; ++i) {
    const auto digits = std::to_string(i);
    REQUIRE(si(digits + " mm", "m") == std::stod(digits + "e-3"));
    REQUIRE(si("0." + digits + " mg", "kg") == std::stod("0." + digits + "e-6"));
  }
}

TEST_CASE("units of another dimension are refused") {
  CHECK(remedy("3 kg", "m") == "replace 'kg' with a unit that converts to m");
  CHECK(remedy("3 m", "1") == "replace 'm' with %, or leave the unit out");
  CHECK(remedy("3 %", "m") == "replace '%' with a unit that converts to m");
  CHECK(remedy("30 degrees", "1") == "replace 'degrees' with %, or leave the unit out");
  CHECK(remedy("30 rad/s", "1/s") == "replace 'rad/s' with a unit that converts to 1/s");
}

TEST_CASE("nothing is converted to the reciprocal, as UDUNITS-2 would") {
  CHECK(remedy("1e-4 s", "1/s") == "replace 's' with a unit that converts to 1/s");
}

TEST_CASE("units with an offset, logarithms and dates are refused") {
  const std::string tail = ", which is not a plain multiple of an SI unit";
  CHECK(remedy("20 degC", "K") == "replace 'degC'" + tail);
  CHECK(remedy("20 lg(re m)", "m") == "replace 'lg(re m)'" + tail);
}

TEST_CASE("what is no unit, or has numbers in it, is refused") {
  for (const std::string unit :
       {"foo", "MM", "m/1000", "m 5", "s^0.5", "N/m^1.5", "5 m", "+2 m", "-2 m", "m*-2", "m/-2",
        "m -2", "/s", "m/", "m^^2", "since 1 m", "s since 1990-01-01", "m @ 5", "m; kg"}) {
    CAPTURE(unit);
    CHECK(remedy("2 " + unit, "m") == "replace '" + unit + "', which is not a known unit");
  }
  CHECK(remedy("2 " + std::string(1000, 'm'), "m") == "shorten the unit");
}

TEST_CASE("quantities are cut between numeral and unit") {
  const auto parts = [](const std::string& text) {
    const auto cut = split_quantity(text).value();
    return std::string(cut.numeral) + "|" + std::string(cut.unit);
  };
  CHECK(parts("0.66 mm") == "0.66|mm");
  CHECK(parts("1e4 1/s") == "1e4|1/s");
  CHECK(parts(".5m") == ".5|m");
  CHECK(parts("2eV") == "2|eV");
  CHECK(parts("0x10") == "0|x10");
  CHECK(parts("+1,5") == "1|,5");
  for (const std::string text :
       {"", " ", "+", "-", "mm", ".", "- 5", "+-5", "inf", "nan", ".inf", "-inf"}) {
    CAPTURE(text);
    CHECK_FALSE(split_quantity(text));
  }
}

TEST_CASE("numerals that no normal double can hold have no value") {
  for (const std::string numeral :
       {"1e999", "-1e999", "1e-999", "1e-310", "4.9e-324", "1e99999999999"}) {
    CAPTURE(numeral);
    CHECK_FALSE(decimal_value(numeral));
  }
  CHECK(decimal_value("0") == 0.0);
  CHECK(decimal_value("0e5") == 0.0);
  CHECK(decimal_value("1e310", -3) == 1e307);
  CHECK_FALSE(decimal_value("1e308", 3));
  CHECK(decimal_value("1.7976931348623157e308") == 1.7976931348623157e308);
  CHECK(decimal_value("2.2250738585072014e-308") == 2.2250738585072014e-308);
  CHECK_FALSE(value_in_si({"1e-307", "inch"}, "km").has_value());
}

TEST_CASE("units may be converted by several threads at once") {
  std::vector<double> values(4);
  std::vector<std::thread> threads;
  for (auto& value : values) {
    threads.emplace_back([&value] {
      for (int i = 0; i < 200; ++i) value = si("0.66 mm", "m");
    });
  }
  for (auto& thread : threads) thread.join();
  for (const double value : values) CHECK(value == 6.6e-4);
}

TEST_CASE("messages have a name and a valid example for every unit they describe") {
  for (const std::string unit :
       {"1", "m", "kg", "s", "1/s", "m/s", "m/s^2", "N/m", "N", "J", "m^2", "kg/m^3", "W", ""}) {
    const auto description = describe_unit(unit);
    CAPTURE(unit, description.example);
    CHECK(split_quantity(description.example).has_value());
    CHECK(si(description.example, unit) > 0.0);
    CHECK_FALSE(description.noun.empty());
  }
}
