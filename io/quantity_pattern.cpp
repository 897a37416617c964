// Regular expressions for quantities, in the syntax that all dialects share.
#include "io/settings_schema.hpp"

#include <fmt/format.h>

#include <map>

namespace riesel::io {
namespace {

const std::string prefix = "(?:da|[YZEPTGMkhdcmu\u00b5npfazy])?";
const std::string long_prefix = "(?:kilo|centi|milli|micro|nano)?";

/// The usual names of a unit that is a single word; empty if this file does not know it.
std::string names_of_unit(const std::string& unit) {
  static const std::map<std::string, std::string> known = {
      {"m", prefix + "m|" + long_prefix + "met(?:er|re)s?"},
      {"kg", prefix + "g|" + long_prefix + "grams?"},
      {"s", prefix + "s|" + long_prefix + "seconds?|min|minutes?|h|hours?|d|days?"},
      {"N", prefix + "N|" + long_prefix + "newtons?"},
      {"J", prefix + "J|" + long_prefix + "joules?"},
  };
  const auto found = known.find(unit);
  return found == known.end() ? "" : "(?:" + found->second + ")";
}

/// An exponent, as in m^2, m2, m² and, for 1, m.
std::string exponent(const std::string& power) {
  if (power == "2") return "(?:\\^?2|\u00b2)";
  return power == "1" ? "(?:\\^?1|\u00b9)?" : "\\^?" + power;
}

/// For "N/m", "m/s^2", "1/s", one word on each side of the slash; empty for anything else.
std::string pattern_of_quotient(const std::string& unit) {
  const auto slash = unit.find('/');
  const std::string above = unit.substr(0, slash);
  std::string below = unit.substr(slash + 1), power = "1";
  if (const auto sign = below.find('^'); sign != std::string::npos) {
    power = below.substr(sign + 1);
    below.resize(sign);
  }
  const std::string one = exponent("1"), denominator = names_of_unit(below);
  const std::string numerator = above == "1" ? "1" : names_of_unit(above) + one;
  if (numerator == one || denominator.empty()) return "";
  const std::string twice =
      power == "2" ? fmt::format("|{0} ?/ ?{1}{2} ?/ ?{1}{2}", numerator, denominator, one) : "";
  return fmt::format("{} ?/ ?{}{}|{}{}\\^?-{}{}", numerator, denominator, exponent(power),
                     above == "1" ? "" : numerator + "[ .*]", denominator, power, twice);
}

/// The usual ways to write a unit and others of its dimension; empty if this file knows none.
std::string pattern_of_known_unit(const std::string& unit) {
  if (unit.find('/') == std::string::npos) {
    const std::string names = names_of_unit(unit);
    return names.empty() ? "" : names + exponent("1");
  }
  std::string quotient = pattern_of_quotient(unit);
  if (unit == "1/s") return quotient + "|" + prefix + "(?:Hz|hertz)";
  if (unit == "m/s^2") return quotient + "|" + pattern_of_quotient("N/kg");
  if (unit == "N/m")
    return quotient + "|" + pattern_of_quotient("kg/s^2") + "|" + pattern_of_quotient("J/m^2");
  return quotient;
}

std::string pattern_of_unit(const std::string& unit) {
  if (unit == "1") return "%|percent|ppm";
  const std::string pattern = pattern_of_known_unit(unit);
  return pattern.empty() ? "\\S.*" : pattern;
}

}  // namespace

std::string quantity_pattern(const std::string& si_unit, bool may_be_negative) {
  const std::string number = "(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)(?:[eE][-+]?[0-9]+)?";
  const std::string unit =
      si_unit.empty() ? "" : fmt::format("(?: *(?:{}))?", pattern_of_unit(si_unit));
  return fmt::format("^{}{}{}$", may_be_negative ? "[-+]?" : "\\+?", number, unit);
}

}  // namespace riesel::io
