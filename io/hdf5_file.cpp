#include "io/hdf5_file.hpp"

#include <hdf5.h>

#include <cstdint>
#include <string>

namespace riesel::io {
namespace {

constexpr std::size_t memory_increment = std::size_t{1} << 20;  // bytes

/// The name under which HDF5 keeps a file in memory. HDF5 takes files of the same name for one and
/// the same, hence the number; and no file on the disk can have such a name.
std::string name_in_memory() {
  static std::uint64_t number = 0;
  return "/dev/null/" + std::to_string(++number);
}

std::size_t user_block_of(const Hdf5Handle& file) {
  const std::string what = "read the properties of the file";
  const Hdf5Handle properties(H5Fget_create_plist(file.id()), H5Pclose, what);
  hsize_t size = 0;
  check_hdf5(H5Pget_userblock(properties.id(), &size), what);
  return size;
}

}  // namespace

Hdf5File::Hdf5File(Hdf5Handle handle) : handle_(std::move(handle)) {}

Hdf5File Hdf5File::create(std::size_t user_block) {
  silence_hdf5();
  const std::string what = "create a file in memory";
  const Hdf5Handle properties(H5Pcreate(H5P_FILE_CREATE), H5Pclose, what);
  check_hdf5(H5Pset_userblock(properties.id(), user_block), what);
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, what);
  check_hdf5(H5Pset_fapl_core(access.id(), memory_increment, false), what);
  check_hdf5(H5Pset_libver_bounds(access.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V18), what);
  const auto name = name_in_memory();
  return Hdf5File(
      {H5Fcreate(name.c_str(), H5F_ACC_TRUNC, properties.id(), access.id()), H5Fclose, what});
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  silence_hdf5();
  const std::string what = "open the file";
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, what);
  check_hdf5(H5Pset_file_locking(access.id(), false, true), what);
  return Hdf5File({H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose, what});
}

Hdf5Group Hdf5File::root() const {
  return {{H5Gopen2(handle_.id(), "/", H5P_DEFAULT), H5Gclose, "open the group /"}, "/"};
}

std::span<char> Hdf5File::image() {
  const std::string what = "make the image of the file";
  check_hdf5(H5Fflush(handle_.id(), H5F_SCOPE_GLOBAL), what);
  const ssize_t size = H5Fget_file_image(handle_.id(), nullptr, 0);  // without the user block
  check_hdf5(size, what);
  void* place = nullptr;
  check_hdf5(H5Fget_vfd_handle(handle_.id(), H5P_DEFAULT, &place), what);
  return {*static_cast<char**>(place), static_cast<std::size_t>(size) + user_block_of(handle_)};
}

}  // namespace riesel::io
