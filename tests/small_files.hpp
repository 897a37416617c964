// Small files of runs that hold something of everything, for tests that damage them.
#pragma once

#include "io/run_file.hpp"

#include <filesystem>
#include <vector>

namespace riesel {

/// Of the small run file, which has 3 rows.
extern const std::vector<io::Column> small_columns;

/// A tube with a few grains, contacts and visits to walls.
void write_small_checkpoint(const std::filesystem::path& path);
void write_small_run_file(const std::filesystem::path& path);

/// Goes on with a trajectory of the same tube as if one of its frames had been the last.
void reopen_small_trajectory(const std::filesystem::path& path);
void write_small_trajectory(const std::filesystem::path& path);

/// The bytes of the file that `write` makes.
std::vector<char> small_file(void (*write)(const std::filesystem::path&));

}  // namespace riesel
