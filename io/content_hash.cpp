#include "io/content_hash.hpp"

#include "engine/hash.hpp"
#include "io/checkpoint.hpp"
#include "io/file_error.hpp"
#include "io/whole_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace riesel::io {

std::string hash_of_text(std::string_view text) {
  Hash hash;
  hash.add_text(text);
  return fmt::format("{:016x}", hash.value());
}

std::string hash_of_content(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  try {
    const auto content = read_whole_file(
        fs::is_directory(path, ignored) ? fs::path(path) / checkpoint_name : fs::path(path));
    return hash_of_text({content.data(), content.size()});
  } catch (const FileError&) {
    return "none";
  }
}

}  // namespace riesel::io
