// Checks of function arguments.
#pragma once

#include <stdexcept>

namespace riesel {

/// Throws std::invalid_argument(otherwise) unless `condition` is true.
inline void require(bool condition, const char* otherwise) {
  if (!condition) throw std::invalid_argument(otherwise);
}

}  // namespace riesel
