// Work in a process of its own, where memory and start-up can be measured without what else the
// suite has done before.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace riesel::bench {

/// What a command prints. Throws std::runtime_error if it fails.
std::string output_of(const std::vector<std::string>& command);

/// Calls this program again with `arguments` and returns the JSON that it prints. Throws
/// std::runtime_error if it fails.
nlohmann::json ask_child(const std::vector<std::string>& arguments);

}  // namespace riesel::bench
