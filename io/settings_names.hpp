// Helping a user who mistyped a name: the nearest valid one, or where the name belongs.
#pragma once

#include "io/settings_table.hpp"

#include <optional>
#include <string>
#include <vector>

namespace riesel::io {

/// The candidate that is the fewest typing errors from `name` (insertion, deletion, replacement or
/// swap of a letter, case ignored); nothing if even that one differs too much to have been meant.
std::optional<std::string> nearest_name(const std::string& name,
                                        const std::vector<std::string>& candidates);

/// "did you mean 'b'?", with the nearest_name(); nothing if there is none.
std::optional<std::string> did_you_mean(const std::string& name,
                                        const std::vector<std::string>& candidates);

/// "a, b or c"
std::string enumerate(const std::vector<std::string>& names);

/// What to do about a key or section that the table of `scenario` does not hold.
std::string unknown_key_remedy(const std::string& key, const std::string& scenario,
                               const SettingsTables& tables);

}  // namespace riesel::io
