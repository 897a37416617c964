// Colours for numbers, from dark blue through green to light yellow. Lightness rises all the way,
// so that the order can be seen without seeing colours, and on paper.
#pragma once

#include <string>

namespace riesel::io {

/// "#rrggbb" for a place in the scale, from 0 to 1; places beyond get the colours of its ends, NaN
/// is grey.
std::string colour(double fraction);

}  // namespace riesel::io
