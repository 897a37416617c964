// JSON values as cells of a table. Internal.
#pragma once

#include "io/json_file.hpp"
#include "io/sweep_manifest.hpp"

#include <cstdint>
#include <string>

namespace riesel::io {

/// Nothing for null, lists and maps. true and false become texts, as do integers that a double may
/// not hold exactly (a seed, for example).
inline Cell cell_of(const Json& json) {
  constexpr std::int64_t most = std::int64_t{1} << 53;
  if (json.is_number_integer() && (json > most || json < -most)) return json.dump();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  if (json.is_boolean()) return std::string(json.get<bool>() ? "true" : "false");
  return {};
}

}  // namespace riesel::io
