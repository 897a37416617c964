// JSON files, read and written as a whole. Internal.
#pragma once

#include <nlohmann/json.hpp>

#include <concepts>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

namespace riesel::io {

using Json = nlohmann::ordered_json;

/// What to do about a file that is none of this program's.
struct JsonRemedies {
  std::string unreadable;  ///< it cannot be read, or is larger than any that this program writes
  std::string damaged;     ///< it is not complete JSON
};

/// Larger files are not read. The summary of the longest curve takes 22 MB; reading takes up to 16
/// times as much memory.
inline constexpr std::uint64_t largest_json = 32'000'000;  // bytes

/// The content of the file. Throws FileError if it cannot be read or is not JSON; that includes
/// what is nested deeper than anything that this program writes (code that walks through it could
/// exhaust the stack).
Json read_json(const std::filesystem::path& path, const JsonRemedies& remedies);

/// A number that is written as an integer and fits into T. Throws std::exception for anything else.
template <std::signed_integral T>
T integer_of(const Json& json) {
  const bool fits = json.is_number_unsigned()
                        ? std::in_range<T>(json.get<std::uint64_t>())
                        : json.is_number_integer() && std::in_range<T>(json.get<std::int64_t>());
  if (!fits) throw std::runtime_error(json.dump() + " is not an integer that fits here");
  return json.get<T>();
}

/// For a message: what is wrong with valid JSON, from which reading values has thrown `error`.
std::string flaw_of(const std::exception& error);

/// On several lines. Bytes that are not UTF-8 (in a message of the system, say) are replaced.
inline std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace riesel::io
