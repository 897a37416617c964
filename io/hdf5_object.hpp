// Groups, data sets and attributes of an HDF5 file, as far as this program needs them.
//
// Numbers are stored with their own types, little-endian: 32- and 64-bit integers and doubles. Data
// sets of numbers are tables of rows, cut into chunks with a checksum each (fletcher32), so that
// any reader notices damage. They carry no times, so that equal contents give equal files.
//
// Files are read back by stored_hdf5.hpp. The members here that read attributes and texts, and
// copy(), are for tests, which look at the written file with HDF5's own library, as other programs
// do (Hdf5File::open()).
//
// All members throw Hdf5Error.
#pragma once

#include "io/hdf5_handle.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace riesel::io {

template <class T>
concept Hdf5Number = std::same_as<T, std::int32_t> || std::same_as<T, std::int64_t> || std::same_as<
    T, std::uint64_t> || std::same_as<T, double>;

/// What groups and data sets have in common: attributes.
class Hdf5Object {
public:
  template <Hdf5Number T>
  void set_attribute(const std::string& name, T value);
  void set_attribute(const std::string& name, std::string_view text);  ///< less than 64 kB

  template <Hdf5Number T>
  T attribute(const std::string& name) const;
  std::string text_attribute(const std::string& name) const;

protected:
  Hdf5Object(Hdf5Handle handle, std::string path);

  Hdf5Handle::Id id() const { return handle_.id(); }
  const std::string& path() const { return path_; }
  std::string path_of(const std::string& name) const;

private:
  Hdf5Handle handle_;
  std::string path_;  ///< in the file, for errors
};

/// The shape of a data set of numbers.
struct Hdf5Shape {
  std::size_t rows = 0;
  std::size_t columns = 1;  ///< numbers in a row; 1 makes the data set one-dimensional
  bool growing = false;     ///< more rows may be appended
};

/// A data set of numbers. Spans hold it row by row.
class Hdf5Data : public Hdf5Object {
public:
  Hdf5Shape shape() const;

  /// All of it; the span has rows * columns elements. T must be the stored type.
  template <Hdf5Number T>
  void write(std::span<const T> values);
  template <Hdf5Number T>
  void read(std::span<T> values) const;

  /// Adds rows after the last one of a growing data set.
  template <Hdf5Number T>
  void append(std::span<const T> values);

private:
  friend class Hdf5Group;
  using Hdf5Object::Hdf5Object;
};

class Hdf5Group : public Hdf5Object {
public:
  bool has(const std::string& name) const;
  void remove(const std::string& name);
  void copy(const Hdf5Group& from, const std::string& name);  ///< with all that is in it

  Hdf5Group create_group(const std::string& name);
  Hdf5Group group(const std::string& name) const;

  template <Hdf5Number T>
  Hdf5Data create_data(const std::string& name, const Hdf5Shape& shape);
  Hdf5Data data(const std::string& name) const;

  /// A text of any length, as a data set: a UTF-8 string of fixed length, without checksum.
  /// read_text() refuses one that claims to be longer than `most_bytes`.
  void write_text(const std::string& name, std::string_view text);
  std::string read_text(const std::string& name, std::size_t most_bytes) const;

  /// Many texts as one data set: strings of one length, that of the longest, padded with zeros.
  void write_texts(const std::string& name, const std::vector<std::string>& texts);

private:
  friend class Hdf5File;
  using Hdf5Object::Hdf5Object;
};

}  // namespace riesel::io
