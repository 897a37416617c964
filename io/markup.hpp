// Text in HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace riesel::io {

/// The text as it stands in an element or in a quoted attribute: what has a meaning in markup is
/// written as an entity, control characters other than line breaks and tabs as U+FFFD.
std::string escaped(std::string_view text);

}  // namespace riesel::io
