// HDF5's identifiers and errors in the style of C++: handles that close themselves, and failures
// that are exceptions with one readable line.
//
// The headers hdf5_*.hpp hide the C API and do not include it, so that the files of a run can be
// read and written without knowing it. HDF5 is not thread-safe: use it from one thread at a time.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace riesel::io {

/// A failed call of HDF5. what() is one line: what was attempted, and HDF5's reasons.
class Hdf5Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Throws Hdf5Error with the text `flaw` unless `is_so`.
inline void require(bool is_so, std::string_view flaw) {
  if (!is_so) throw Hdf5Error(std::string(flaw));
}

/// An identifier of HDF5 (hid_t), closed by the destructor.
class Hdf5Handle {
public:
  using Id = std::int64_t;
  using Close = int (*)(Id);

  /// Takes over what a call of HDF5 returned. If that is negative, the call failed: throws its
  /// Hdf5Error, where `what` says what it was to do ("open data set x").
  Hdf5Handle(Id id, Close close, const std::string& what);
  ~Hdf5Handle();

  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  Id id() const { return id_; }

private:
  Id id_;
  Close close_;
};

/// Throws the Hdf5Error of the last call if `status`, the value it returned, is negative.
void check_hdf5(std::int64_t status, const std::string& what);

/// Makes HDF5 print nothing to stderr from now on.
void silence_hdf5();

}  // namespace riesel::io
