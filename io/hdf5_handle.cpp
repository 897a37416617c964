#include "io/hdf5_handle.hpp"

#include <hdf5.h>

#include <string_view>
#include <type_traits>

namespace riesel::io {
namespace {

static_assert(std::is_same_v<hid_t, Hdf5Handle::Id> && std::is_same_v<herr_t, int>);

/// Collects the reasons on HDF5's stack, from the call that was made down to where it failed.
herr_t add_reason(unsigned /*depth*/, const H5E_error2_t* error, void* reasons) {
  auto& text = *static_cast<std::string*>(reasons);
  const std::string_view reason = error->desc == nullptr ? "" : error->desc;
  if (!reason.empty() && !text.ends_with(reason)) text.append(": ").append(reason);
  return 0;
}

std::string without_line_breaks(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

[[noreturn]] void throw_last_error(const std::string& what) {
  std::string text = "cannot " + what;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, add_reason, &text);
  H5Eclear2(H5E_DEFAULT);
  throw Hdf5Error(without_line_breaks(std::move(text)));
}

}  // namespace

Hdf5Handle::Hdf5Handle(Id id, Close close, const std::string& what) : id_(id), close_(close) {
  check_hdf5(id, what);
}

Hdf5Handle::~Hdf5Handle() {
  if (id_ >= 0) close_(id_);
}

void check_hdf5(std::int64_t status, const std::string& what) {
  if (status < 0) throw_last_error(what);
}

void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

}  // namespace riesel::io
