// Units: from the text "0.66 mm" to the double 6.6e-4.
//
// UDUNITS-2 knows the units; this file decides which of its answers are fit for a settings file. It
// is stricter than the library, which would convert seconds to hertz by taking the reciprocal, take
// radians for pure numbers and silently add the offset of degrees Celsius: each of these is a
// mistake in a settings file, so only a change of scale between equal dimensions passes.
//
// A conversion by a power of ten shifts the decimal exponent of the text instead of multiplying, so
// that "0.66 mm" and "6.6e-4" are the same double and not merely close.
//
// UDUNITS-2 reads its database of units at the first unit string, not before; all functions here
// may be called from several threads.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace riesel::io {

/// A unit that cannot be converted. what() is a remedy that completes the sentence "expected ...,
/// got ...; ".
class UnitError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// How messages describe a quantity with this SI unit.
struct UnitDescription {
  std::string noun;     ///< "a length"
  std::string example;  ///< "0.66 mm"
};
UnitDescription describe_unit(const std::string& si_unit);

/// The text of a quantity, cut into its numeral and its unit (empty where there is none).
struct QuantityText {
  std::string_view numeral;
  std::string_view unit;
};

/// Cuts "0.66 mm" in two; nothing if the text does not begin with a decimal numeral. Neither part
/// is checked further.
std::optional<QuantityText> split_quantity(std::string_view text);

/// The value of a decimal numeral times 10^shift, rounded once; nothing if that overflows or is too
/// small for a normal double.
std::optional<double> decimal_value(std::string_view numeral, int shift = 0);

/// The value of `quantity` in `si_unit`. Without a unit the numeral counts as SI. Nothing if no
/// normal double can hold it; throws UnitError if the unit is unknown, has an offset, or is of
/// another dimension than `si_unit`.
std::optional<double> value_in_si(const QuantityText& quantity, const std::string& si_unit);

}  // namespace riesel::io
