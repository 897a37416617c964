#include "bench/output_place.hpp"

#include "bench/mistake.hpp"

#include <unistd.h>

#include <system_error>

namespace riesel::bench {

void reject_unfit_place(const std::filesystem::path& out) {
  const std::filesystem::path folder = std::filesystem::absolute(out).parent_path();
  std::error_code none;
  std::filesystem::create_directories(folder, none);
  const bool fit = std::filesystem::is_directory(folder) && ::access(folder.c_str(), W_OK) == 0
                   && !std::filesystem::is_directory(out);
  if (!fit) throw Mistake(out.string() + ": cannot be written; choose another place with --out");
}

}  // namespace riesel::bench
