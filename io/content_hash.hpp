// Hashes that tell runs apart: of their settings, and of the files that these name, wherever they
// are.
#pragma once

#include <string>
#include <string_view>

namespace riesel::io {

/// 16 hexadecimal digits.
std::string hash_of_text(std::string_view text);

/// Of the content of a file, or of the checkpoint in a run's directory; "none" if it cannot be
/// read, which the run will report.
std::string hash_of_content(const std::string& path);

}  // namespace riesel::io
