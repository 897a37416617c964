// The exception by which a run ends itself.
#pragma once

#include <stdexcept>

namespace riesel {

/// The run cannot go on; what() says where, when and why.
class RunFailure : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace riesel
