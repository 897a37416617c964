#include "io/json_file.hpp"

#include "io/file_error.hpp"
#include "io/whole_file.hpp"

#include <vector>

namespace riesel::io {
namespace {

constexpr int deepest_nesting = 16;

std::vector<char> read_bytes(const std::filesystem::path& path, const std::string& remedy) {
  try {
    return read_whole_file(path, largest_json);
  } catch (const FileError& error) {
    throw FileError(path, error.problem(), remedy);
  }
}

/// Counted before anything is built. Brackets within quotes do not count.
bool is_too_deep(const std::vector<char>& bytes) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char c = bytes[i];
    if (c == '"') in_text = !in_text;
    if (in_text && c == '\\') ++i;
    if (in_text) continue;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > deepest_nesting) return true;
  }
  return false;
}

}  // namespace

std::string flaw_of(const std::exception& error) {
  std::string text = error.what();
  if (dynamic_cast<const Json::out_of_range*>(&error) != nullptr)
    return text.substr(text.find("] ") + 2);  // after the library's name and number of the error
  if (dynamic_cast<const Json::exception*>(&error) != nullptr)
    return "a value in it has the wrong type";
  return text;
}

Json read_json(const std::filesystem::path& path, const JsonRemedies& remedies) {
  const auto bytes = read_bytes(path, remedies.unreadable);
  if (is_too_deep(bytes)) throw FileError(path, "is nested too deeply", remedies.damaged);
  Json json = Json::parse(bytes, nullptr, false);
  if (json.is_discarded()) throw FileError(path, "is not complete JSON", remedies.damaged);
  return json;
}

}  // namespace riesel::io
