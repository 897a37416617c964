#include "io/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace riesel::io {
namespace {

constexpr std::size_t longest_unit = 64;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// --- what UDUNITS-2 says about a unit ---

struct FreeSystem {
  void operator()(ut_system* system) const { ut_free_system(system); }
};
struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using System = std::unique_ptr<ut_system, FreeSystem>;
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

/// A unit taken apart: scale times a product of powers of base units. The radian counts as a base
/// unit, as in UDUNITS-2, so that angles are not pure numbers here.
struct Dissection {
  double scale = 1.0;
  std::map<std::string, int> powers;
  bool only_scaled = true;  ///< false if the unit has an offset, is logarithmic or is a date
};

void count_base_unit(Dissection& dissection, const ut_unit* base, int power) {
  const char* symbol = ut_get_symbol(base, UT_UTF8);
  if (symbol == nullptr) symbol = ut_get_name(base, UT_UTF8);
  dissection.powers[symbol == nullptr ? "?" : symbol] += power;
}

ut_status visit_basic(const ut_unit* unit, void* arg) {
  count_base_unit(*static_cast<Dissection*>(arg), unit, 1);
  return UT_SUCCESS;
}

ut_status visit_product(const ut_unit*, int count, const ut_unit* const* bases, const int* powers,
                        void* arg) {
  for (int i = 0; i < count; ++i) {
    count_base_unit(*static_cast<Dissection*>(arg), bases[i], powers[i]);
  }
  return UT_SUCCESS;
}

ut_status visit_scaled(const ut_unit*, double scale, const ut_unit* underlying, double offset,
                       void* arg);

ut_status visit_date(const ut_unit*, const ut_unit*, double, void* arg) {
  static_cast<Dissection*>(arg)->only_scaled = false;
  return UT_SUCCESS;
}

ut_status visit_logarithm(const ut_unit*, double, const ut_unit*, void* arg) {
  static_cast<Dissection*>(arg)->only_scaled = false;
  return UT_SUCCESS;
}

const ut_visitor visitor = {visit_basic, visit_product, visit_scaled, visit_date, visit_logarithm};

ut_status visit_scaled(const ut_unit*, double scale, const ut_unit* underlying, double offset,
                       void* arg) {
  auto& dissection = *static_cast<Dissection*>(arg);
  dissection.scale *= scale;
  if (offset != 0.0) dissection.only_scaled = false;
  return ut_accept_visitor(underlying, &visitor, arg);
}

/// The database of units, read once. Neither it nor the parser of UDUNITS-2 may be used by two
/// threads at a time.
class UnitDatabase {
public:
  static UnitDatabase& instance() {
    static UnitDatabase database;
    return database;
  }

  /// Nothing if UDUNITS-2 cannot parse the unit.
  std::optional<Dissection> dissect(const std::string& unit) {
    const std::scoped_lock lock(mutex_);
    if (!system_) {
      throw UnitError("give the number in SI units: the database of UDUNITS-2 cannot be read "
                      "(UDUNITS2_XML_PATH may name its udunits2.xml)");
    }
    const Unit parsed(ut_parse(system_.get(), unit.c_str(), UT_UTF8));
    Dissection dissection;
    if (!parsed || ut_accept_visitor(parsed.get(), &visitor, &dissection) != UT_SUCCESS) return {};
    return dissection;
  }

private:
  UnitDatabase() {
    ut_set_error_message_handler(ut_ignore);  // it would print to stderr
    system_.reset(ut_read_xml(nullptr));
  }

  std::mutex mutex_;
  System system_;
};

// --- what a settings file may say ---

/// Whether a digit after this text belongs to an exponent, as in "m2", "m^2" and "m^-2".
bool leads_to_exponent(std::string_view text) {
  if (text.ends_with('+') || text.ends_with('-')) text.remove_suffix(1);
  return !text.empty() && (is_letter(text.back()) || text.back() == '^');
}

/// UDUNITS-2 takes "5 m", "m 5", "-5 m" and "m/1000" for units, and "s^0.5" for "5 s^0". In a
/// settings file numbers belong in the numeral; within a unit only integer exponents and the 1 of
/// "1/s" are plausible.
bool has_only_exponents(std::string_view unit) {
  if (unit.starts_with("1/")) unit.remove_prefix(2);
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const bool begins_number = is_digit(unit[i]) && (i == 0 || !is_digit(unit[i - 1]));
    if (begins_number && !leads_to_exponent(unit.substr(0, i))) return false;
  }
  return true;
}

Dissection dissect_checked(const std::string& unit, const std::string& si_unit) {
  if (unit.size() > longest_unit) throw UnitError("shorten the unit");
  const auto known =
      has_only_exponents(unit) ? UnitDatabase::instance().dissect(unit) : std::nullopt;
  if (!known && unit == "deg") throw UnitError("write 'degrees'");
  if (!known) throw UnitError(fmt::format("replace '{}', which is not a known unit", unit));
  if (!known->only_scaled) {
    throw UnitError(fmt::format("replace '{}', which is not a plain multiple of an SI unit", unit));
  }
  const auto expected = UnitDatabase::instance().dissect(si_unit);
  if (!expected) throw std::logic_error(fmt::format("'{}' is not a unit", si_unit));
  if (known->powers != expected->powers) {
    const auto target = si_unit == "1" ? "with %, or leave the unit out"
                                       : "with a unit that converts to " + si_unit;
    throw UnitError(fmt::format("replace '{}' {}", unit, target));
  }
  return {known->scale / expected->scale, known->powers, true};
}

/// k if `factor` is 10^k up to the rounding of a few operations.
std::optional<int> power_of_ten(double factor) {
  const double exponent = std::round(std::log10(factor));
  const double deviation = std::abs(factor / std::pow(10.0, exponent) - 1.0);
  if (!(deviation < 1e-14)) return {};
  return static_cast<int>(exponent);
}

/// The double if it is zero or normal; others are infinite, NaN, or have lost digits to
/// denormalisation.
std::optional<double> if_normal(double value) {
  if (value == 0.0 || std::isnormal(value)) return value;
  return {};
}

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\n") - first + 1);
}

}  // namespace

UnitDescription describe_unit(const std::string& si_unit) {
  static const std::map<std::string, UnitDescription> known = {
      {"1", {"a pure number", "0.05"}},
      {"m", {"a length", "0.66 mm"}},
      {"kg", {"a mass", "1 mg"}},
      {"s", {"a time", "2 s"}},
      {"1/s", {"a rate", "1e4 1/s"}},
      {"m/s", {"a velocity", "0.5 m/s"}},
      {"rad", {"an angle", "20 degrees"}},
      {"m/s^2", {"an acceleration", "10 m/s^2"}},
      {"N/m", {"a stiffness", "2000 N/m"}},
      {"N", {"a force", "1 mN"}},
      {"J", {"an energy", "1 uJ"}},
      {"m^2", {"an area", "20 cm^2"}},
      {"kg/m^3", {"a density", "2.5 g/cm^3"}},
  };
  const auto found = known.find(si_unit);
  if (found != known.end()) return found->second;
  return {"a quantity", si_unit.empty() ? "1.5" : "1.5 " + si_unit};
}

std::optional<QuantityText> split_quantity(std::string_view text) {
  text = without_blanks(text);
  // from_chars accepts no leading plus, but does accept names of infinities, which are no numerals
  // here.
  const std::size_t sign = text.starts_with('+') || text.starts_with('-') ? 1 : 0;
  if (sign == text.size() || !(is_digit(text[sign]) || text[sign] == '.')) return {};
  if (text.starts_with('+')) text.remove_prefix(1);

  double ignored = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ignored);
  if (error == std::errc::invalid_argument) return {};
  const auto length = static_cast<std::size_t>(end - text.data());
  return QuantityText{text.substr(0, length), without_blanks(text.substr(length))};
}

std::optional<double> decimal_value(std::string_view numeral, int shift) {
  const auto e = numeral.find_first_of("eE");
  const auto mantissa = numeral.substr(0, e);
  int exponent = 0;
  if (e != std::string_view::npos) {
    auto digits = numeral.substr(e + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (parsed.ec != std::errc{}) return {};
  }
  const auto shifted = fmt::format("{}e{}", mantissa, static_cast<long long>(exponent) + shift);
  double value = 0.0;
  const auto parsed = std::from_chars(shifted.data(), shifted.data() + shifted.size(), value);
  if (parsed.ec != std::errc{}) return {};
  return if_normal(value);
}

std::optional<double> value_in_si(const QuantityText& quantity, const std::string& si_unit) {
  if (quantity.unit.empty()) return decimal_value(quantity.numeral);
  const double factor = dissect_checked(std::string(quantity.unit), si_unit).scale;
  if (const auto shift = power_of_ten(factor)) return decimal_value(quantity.numeral, *shift);

  const auto value = decimal_value(quantity.numeral);
  if (!value) return {};
  const double scaled = *value * factor;
  if (scaled == 0.0 && *value != 0.0) return {};
  return if_normal(scaled);
}

}  // namespace riesel::io
