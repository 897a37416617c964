// HDF5 files behind a seal (seal.hpp), written and opened.
#pragma once

#include "io/durable_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/stored_hdf5.hpp"

#include <filesystem>
#include <string_view>

namespace riesel::io {

/// Seals a file that was created with a user block of `seal_size` bytes, and writes it durably.
/// Throws FileError, or Hdf5Error if HDF5 cannot make its image.
void write_sealed_hdf5(const std::filesystem::path& path, Hdf5File& file, std::string_view kind,
                       Previous previous);

/// The root group of a file whose seal has proved right. Throws FileError if the file cannot be
/// read, Hdf5Error if it is damaged or of another kind.
StoredGroup open_sealed_hdf5(const std::filesystem::path& path, std::string_view kind);

}  // namespace riesel::io
