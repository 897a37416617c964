// How fast rigid grains are, in turns with those of the engine by windows.
#pragma once

#include <filesystem>

namespace riesel::bench {

/// Both go on from the checkpoint at `path` for `duration` (s), `rounds` times, on one thread;
/// prints what they took. Throws FileError, and std::invalid_argument as RigidFlow does.
void beside_windows(const std::filesystem::path& path, double duration, int rounds);

}  // namespace riesel::bench
