// Text in HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace riesel::io {

/// The text as it must be written in an element or a quoted attribute: characters that mean
/// something in markup as entities; control characters other than line breaks and tabs, and U+FFFE
/// and U+FFFF, which XML forbids, as U+FFFD.
std::string escaped(std::string_view text);

}  // namespace riesel::io
