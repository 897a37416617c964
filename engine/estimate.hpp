// A measured number with its error.
#pragma once

#include <limits>

namespace riesel {

/// Stands for a number that is not known: NaN.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A number and its 68 % error; either may be unknown.
struct Estimate {
  double value = 0.0, error = 0.0;
};

}  // namespace riesel
