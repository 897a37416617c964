// A measured number.
#pragma once

namespace riesel {

/// A number and its 68 % error; not a number where it is not known.
struct Estimate {
  double value = 0.0, error = 0.0;
};

}  // namespace riesel
