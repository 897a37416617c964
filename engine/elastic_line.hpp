// The elastic part of a normal law as a power of the overlap, from which collision times follow.
#pragma once

namespace riesel {

/// elastic force = stiffness * overlap^exponent
struct ElasticLine {
  double stiffness;  ///< N/m^exponent
  double exponent;
};

}  // namespace riesel
