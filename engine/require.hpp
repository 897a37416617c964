// What a function asks of its arguments.
#pragma once

#include <stdexcept>

namespace riesel {

/// Throws std::invalid_argument(otherwise) unless the condition holds.
inline void require(bool condition, const char* otherwise) {
  if (!condition) throw std::invalid_argument(otherwise);
}

}  // namespace riesel
