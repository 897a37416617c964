// What a command line asks for, and cannot be done: the program ends with status 2.
#pragma once

#include <stdexcept>

namespace riesel::bench {

struct Mistake : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace riesel::bench
