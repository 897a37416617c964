// Colours for numbers: from dark blue by green to light yellow. Lightness grows all the way, so
// that the order is seen by those who see no colours, and on paper.
#pragma once

#include <string>

namespace riesel::io {

/// "#rrggbb" for a place in the scale; below 0 and above 1 the colours of the ends. Not a number is
/// grey.
std::string colour(double fraction);

}  // namespace riesel::io
