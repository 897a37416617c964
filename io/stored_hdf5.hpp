// HDF5 files read back without trust: the files of a run may come from anywhere, and may be damaged
// or made to do damage. HDF5's own library is not written for that: it may crash on such files,
// loads plugins and opens other files if they say so, and allocates whatever memory they claim to
// need.
//
// What this program writes is a small part of the format (classic groups, numbers and texts, one
// filter), so the reader is small, too. It works on the bytes of the file, follows no address
// outside them, copies out no more than a few times their number, only moves forwards along a tree,
// and refuses everything that this program does not write. Its errors are worded like those of
// HDF5's library, see Hdf5Error.
#pragma once

#include "io/hdf5_header.hpp"
#include "io/hdf5_object.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace riesel::io {

/// The bytes of a file, shared by all that is read from it.
struct StoredBytes {
  std::vector<char> all;
  Bytes content;            ///< after the user block: addresses count from here
  std::uint64_t given = 0;  ///< bytes that were copied out so far

  /// Counts what is copied out. A forged file may contain the same bytes in many places: throws
  /// Hdf5Error once far more has been copied than the file has.
  void give(std::uint64_t size);
};

/// What groups and data sets have in common: attributes. Members throw Hdf5Error.
class StoredObject {
public:
  template <Hdf5Number T>
  T attribute(const std::string& name) const;
  std::string text_attribute(const std::string& name) const;

protected:
  StoredObject(std::shared_ptr<StoredBytes> bytes, std::uint64_t address, std::string path);

  const Bytes& file() const { return bytes_->content; }
  const std::shared_ptr<StoredBytes>& bytes() const { return bytes_; }
  const Hdf5Header& header() const { return header_; }
  const std::string& path() const { return path_; }

private:
  const Hdf5Attribute& single_value(const std::string& name) const;
  std::string reading(const std::string& name) const;

  std::shared_ptr<StoredBytes> bytes_;
  Hdf5Header header_;
  std::string path_;  ///< in the file, for errors
};

/// A data set of numbers. Members throw Hdf5Error.
class StoredData : public StoredObject {
public:
  Hdf5Shape shape() const;

  /// All of it, row by row, into a span of rows * columns elements. T must be the stored type.
  template <Hdf5Number T>
  void read(std::span<T> values) const;

private:
  friend class StoredGroup;
  using StoredObject::StoredObject;

  /// Into `memory`, which has room for all elements.
  void read_bytes(std::span<char> memory) const;
};

/// Members throw Hdf5Error.
class StoredGroup : public StoredObject {
public:
  bool has(const std::string& name) const { return members_.contains(name); }
  /// The names of all members, in alphabetical order.
  std::vector<std::string> names() const;
  bool is_group(const std::string& name) const;

  StoredGroup group(const std::string& name) const;
  StoredData data(const std::string& name) const;
  std::string text(const std::string& name) const;

private:
  friend StoredGroup stored_hdf5(std::vector<char> bytes, std::size_t user_block);
  StoredGroup(std::shared_ptr<StoredBytes> bytes, std::uint64_t address, std::string path);

  std::uint64_t address_of(const std::string& name) const;
  std::string path_of(const std::string& name) const;

  std::map<std::string, std::uint64_t> members_;  ///< addresses of their headers
};

/// The root group of the HDF5 file with these bytes, the first `user_block` of which are not
/// HDF5's. Throws Hdf5Error.
StoredGroup stored_hdf5(std::vector<char> bytes, std::size_t user_block);

}  // namespace riesel::io
