// HDF5 files, made in memory.
//
// HDF5 writes in place, and if that fails (on a full disk) the library cannot even close the file
// properly. So it never writes: the finished image of the file goes to write_durably(). The format
// is the classic one, which every HDF5 since 1.8 reads.
#pragma once

#include "io/hdf5_object.hpp"

#include <cstddef>
#include <filesystem>
#include <span>

namespace riesel::io {

class Hdf5File {
public:
  /// An empty file in memory. It begins with a user block of this many bytes, which HDF5 leaves
  /// alone: 0, or a power of two from 512 on.
  static Hdf5File create(std::size_t user_block = 0);

  /// Opens a file that this process has written, for tests that other HDF5 programs can read it:
  /// HDF5's parser is not safe on damaged files, see stored_hdf5.hpp. Throws Hdf5Error.
  static Hdf5File open(const std::filesystem::path& path);

  Hdf5Group root() const;

  /// The bytes of a file in memory as it is now; valid until the next call of HDF5. The user block,
  /// if any, comes first and may be written.
  std::span<char> image();

private:
  explicit Hdf5File(Hdf5Handle handle);

  Hdf5Handle handle_;
};

}  // namespace riesel::io
