#include "bench/scratch_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

namespace riesel::bench {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(const fs::path& parent) {
  fs::create_directories(parent);
  std::string name = parent / "scratch-XXXXXX";
  if (mkdtemp(name.data()) == nullptr)
    throw fs::filesystem_error("no folder can be made", parent,
                               std::error_code(errno, std::generic_category()));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace riesel::bench
