// riesel status: how far a sweep has come.
#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/print_sweep.hpp"
#include "app/sweep_directory.hpp"

namespace riesel::app {

namespace fs = std::filesystem;

int sweep_status(const fs::path& directory) {
  io::Manifest manifest = manifest_in(directory);
  refresh(manifest, directory);
  note_misplaced(manifest, directory);
  print_status(manifest, directory);
  return exit_done;
}

}  // namespace riesel::app
