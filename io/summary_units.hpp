// The units of the values in a summary, for tables that list them by name.
#pragma once

#include <string>
#include <string_view>

namespace riesel::io {

/// SI unit of a value by the name that flat_summary() gives it ("balance.errors.n_dot": "1/s");
/// empty for what has none.
std::string unit_of_result(std::string_view name);

}  // namespace riesel::io
