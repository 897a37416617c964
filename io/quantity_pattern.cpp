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

/// Other units of the same dimension.
std::string aliases_of_unit(const std::string& unit) {
  if (unit == "1/s") return "|" + prefix + "(?:Hz|hertz)";
  if (unit == "N/m") return fmt::format("|{}/{}\\^?2", names_of_unit("kg"), names_of_unit("s"));
  return "";
}

/// For "N/m", "m/s^2", "1/s", one word on each side of the slash; empty for anything else.
std::string pattern_of_quotient(const std::string& unit) {
  const auto slash = unit.find('/');
  const std::string above = unit.substr(0, slash);
  std::string below = unit.substr(slash + 1), power;
  if (const auto sign = below.find('^'); sign != std::string::npos) {
    power = below.substr(sign + 1);
    below.resize(sign);
  }
  const std::string numerator = above == "1" ? "1" : names_of_unit(above);
  const std::string denominator = names_of_unit(below);
  if (numerator.empty() || denominator.empty()) return "";
  const std::string exponent = power.empty() ? "" : "\\^?" + power;
  return fmt::format("{0} ?/ ?{1}{2}|{3}{1}\\^?-{4}", numerator, denominator, exponent,
                     above == "1" ? "" : numerator + "[ .*]", power.empty() ? "1" : power);
}

std::string pattern_of_unit(const std::string& unit) {
  if (unit == "1") return "%|percent|ppm";
  const std::string pattern =
      unit.find('/') == std::string::npos ? names_of_unit(unit) : pattern_of_quotient(unit);
  return pattern.empty() ? "\\S.*" : pattern + aliases_of_unit(unit);
}

}  // namespace

std::string quantity_pattern(const std::string& si_unit, bool may_be_negative) {
  const std::string number = "(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)(?:[eE][-+]?[0-9]+)?";
  const std::string unit =
      si_unit.empty() ? "" : fmt::format("(?: *(?:{}))?", pattern_of_unit(si_unit));
  return fmt::format("^{}{}{}$", may_be_negative ? "[-+]?" : "\\+?", number, unit);
}

}  // namespace riesel::io
