#include "io/hdf5_object.hpp"

#include "io/bytes.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>

namespace riesel::io {
namespace {

constexpr std::size_t values_per_chunk = 65536;
constexpr std::size_t growing_rows_per_chunk = 1024;

template <class T>
struct TypeOf;
template <>
struct TypeOf<std::int32_t> {
  static hid_t stored() { return H5T_STD_I32LE; }
  static hid_t native() { return H5T_NATIVE_INT32; }
};
template <>
struct TypeOf<std::int64_t> {
  static hid_t stored() { return H5T_STD_I64LE; }
  static hid_t native() { return H5T_NATIVE_INT64; }
};
template <>
struct TypeOf<std::uint64_t> {
  static hid_t stored() { return H5T_STD_U64LE; }
  static hid_t native() { return H5T_NATIVE_UINT64; }
};
template <>
struct TypeOf<double> {
  static hid_t stored() { return H5T_IEEE_F64LE; }
  static hid_t native() { return H5T_NATIVE_DOUBLE; }
};

/// A UTF-8 string of fixed length, padded with zeros. HDF5 has none of length 0.
Hdf5Handle text_type(std::size_t length) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  check_hdf5(H5Tset_size(type.id(), std::max<std::size_t>(length, 1)), "set the length of a text");
  check_hdf5(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), "set the padding of a text");
  check_hdf5(H5Tset_cset(type.id(), H5T_CSET_UTF8), "set the encoding of a text");
  return type;
}

/// Where HDF5 may read at least one byte, even if the text is empty.
const char* bytes_of(std::string_view text) { return text.empty() ? "" : text.data(); }

void check_type(hid_t type, hid_t expected, const std::string& what) {
  const htri_t equal = H5Tequal(type, expected);
  check_hdf5(equal, what);
  if (equal == 0) throw Hdf5Error("cannot " + what + ": it has another type");
}

/// The length of a text type. Throws Hdf5Error for anything but text of fixed length.
std::size_t text_length(hid_t type, const std::string& what) {
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) {
    throw Hdf5Error("cannot " + what + ": it is not a text of fixed length");
  }
  return H5Tget_size(type);
}

void check_scalar(hid_t space, const std::string& what) {
  if (H5Sget_simple_extent_npoints(space) != 1) {
    throw Hdf5Error("cannot " + what + ": it is not a single value");
  }
}

Hdf5Handle scalar_space() { return {H5Screate(H5S_SCALAR), H5Sclose, "make a scalar"}; }

Hdf5Handle open_attribute(hid_t object, const std::string& name, const std::string& what) {
  Hdf5Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, what);
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose, what);
  check_scalar(space.id(), what);
  return attribute;
}

/// Writes an attribute, in place of an older one.
void write_attribute(hid_t object, const std::string& name, hid_t type, const void* memory,
                     hid_t memory_type, const std::string& what) {
  const htri_t exists = H5Aexists(object, name.c_str());
  check_hdf5(exists, what);
  if (exists > 0) check_hdf5(H5Adelete(object, name.c_str()), what);
  const auto space = scalar_space();
  const Hdf5Handle attribute(
      H5Acreate2(object, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  check_hdf5(H5Awrite(attribute.id(), memory_type, memory), what);
}

using Extent = std::array<hsize_t, 2>;

int dimensions(const Hdf5Shape& shape) { return shape.columns == 1 ? 1 : 2; }

Hdf5Handle create_space(const Hdf5Shape& shape, const std::string& what) {
  const Extent now = {shape.rows, shape.columns};
  const Extent most = {shape.growing ? H5S_UNLIMITED : shape.rows, shape.columns};
  return {H5Screate_simple(dimensions(shape), now.data(), most.data()), H5Sclose, what};
}

/// Properties for the creation of a data set that records no times.
Hdf5Handle timeless(const std::string& what) {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  check_hdf5(H5Pset_obj_track_times(properties.id(), false), what);
  return properties;
}

/// Chunks with checksums, except for an empty data set that cannot grow: it can have no chunks.
Hdf5Handle creation_properties(const Hdf5Shape& shape, const std::string& what) {
  auto properties = timeless(what);
  if (shape.rows == 0 && !shape.growing) return properties;
  const std::size_t rows =
      shape.growing ? growing_rows_per_chunk
                    : std::clamp<std::size_t>(values_per_chunk / shape.columns, 1, shape.rows);
  const Extent chunk = {rows, shape.columns};
  check_hdf5(H5Pset_chunk(properties.id(), dimensions(shape), chunk.data()), what);
  check_hdf5(H5Pset_fletcher32(properties.id()), what);
  return properties;
}

/// A data set of texts, which is not chunked.
void write_new_data(hid_t group, const std::string& name, const Hdf5Handle& type,
                    const Hdf5Handle& space, const void* memory, const std::string& what) {
  const auto properties = timeless(what);
  const Hdf5Handle data(H5Dcreate2(group, name.c_str(), type.id(), space.id(), H5P_DEFAULT,
                                   properties.id(), H5P_DEFAULT),
                        H5Dclose, what);
  check_hdf5(H5Dwrite(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, memory), what);
}

void check_size(std::size_t size, const Hdf5Shape& shape, const std::string& what) {
  if (size != shape.rows * shape.columns) {
    throw Hdf5Error("cannot " + what + ": the size does not match");
  }
}

}  // namespace

Hdf5Object::Hdf5Object(Hdf5Handle handle, std::string path)
    : handle_(std::move(handle)), path_(std::move(path)) {}

std::string Hdf5Object::path_of(const std::string& name) const {
  return path_.ends_with('/') ? path_ + name : path_ + '/' + name;
}

template <Hdf5Number T>
void Hdf5Object::set_attribute(const std::string& name, T value) {
  write_attribute(id(), name, TypeOf<T>::stored(), &value, TypeOf<T>::native(),
                  "write the attribute " + name + " of " + path_);
}

void Hdf5Object::set_attribute(const std::string& name, std::string_view text) {
  const auto type = text_type(text.size());
  write_attribute(id(), name, type.id(), bytes_of(text), type.id(),
                  "write the attribute " + name + " of " + path_);
}

template <Hdf5Number T>
T Hdf5Object::attribute(const std::string& name) const {
  const auto what = "read the attribute " + name + " of " + path_;
  const auto attribute = open_attribute(id(), name, what);
  const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose, what);
  check_type(type.id(), TypeOf<T>::stored(), what);
  T value{};
  check_hdf5(H5Aread(attribute.id(), TypeOf<T>::native(), &value), what);
  return value;
}

std::string Hdf5Object::text_attribute(const std::string& name) const {
  const auto what = "read the attribute " + name + " of " + path_;
  const auto attribute = open_attribute(id(), name, what);
  const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose, what);
  std::string text(text_length(type.id(), what), '\0');
  check_hdf5(H5Aread(attribute.id(), type.id(), text.data()), what);
  return without_padding(text);
}

Hdf5Shape Hdf5Data::shape() const {
  const auto what = "read the shape of " + path();
  const Hdf5Handle space(H5Dget_space(id()), H5Sclose, what);
  const int dimensions = H5Sget_simple_extent_ndims(space.id());
  Extent now = {0, 1}, most = {0, 1};
  if (dimensions != 1 && dimensions != 2) throw Hdf5Error("cannot " + what + ": it is not a table");
  check_hdf5(H5Sget_simple_extent_dims(space.id(), now.data(), most.data()), what);
  return {.rows = now[0], .columns = now[1], .growing = most[0] == H5S_UNLIMITED};
}

template <Hdf5Number T>
void Hdf5Data::write(std::span<const T> values) {
  const auto what = "write the data set " + path();
  check_size(values.size(), shape(), what);
  check_hdf5(H5Dwrite(id(), TypeOf<T>::native(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
             what);
}

template <Hdf5Number T>
void Hdf5Data::read(std::span<T> values) const {
  const auto what = "read the data set " + path();
  const Hdf5Handle type(H5Dget_type(id()), H5Tclose, what);
  check_type(type.id(), TypeOf<T>::stored(), what);
  check_size(values.size(), shape(), what);
  check_hdf5(H5Dread(id(), TypeOf<T>::native(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
             what);
}

template <Hdf5Number T>
void Hdf5Data::append(std::span<const T> values) {
  const auto what = "append to the data set " + path();
  const Hdf5Shape old = shape();
  const Hdf5Shape added = {.rows = values.size() / old.columns, .columns = old.columns};
  check_size(values.size(), added, what);
  const Extent start = {old.rows, 0}, count = {added.rows, added.columns};
  const Extent extent = {old.rows + added.rows, old.columns};
  check_hdf5(H5Dset_extent(id(), extent.data()), what);
  const Hdf5Handle place(H5Dget_space(id()), H5Sclose, what);
  check_hdf5(
      H5Sselect_hyperslab(place.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
      what);
  const auto memory = create_space(added, what);
  check_hdf5(
      H5Dwrite(id(), TypeOf<T>::native(), memory.id(), place.id(), H5P_DEFAULT, values.data()),
      what);
}

bool Hdf5Group::has(const std::string& name) const {
  const htri_t exists = H5Lexists(id(), name.c_str(), H5P_DEFAULT);
  check_hdf5(exists, "look for " + path_of(name));
  return exists > 0;
}

void Hdf5Group::remove(const std::string& name) {
  check_hdf5(H5Ldelete(id(), name.c_str(), H5P_DEFAULT), "remove " + path_of(name));
}

void Hdf5Group::copy(const Hdf5Group& from, const std::string& name) {
  check_hdf5(H5Ocopy(from.id(), name.c_str(), id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
             "copy " + from.path_of(name));
}

Hdf5Group Hdf5Group::create_group(const std::string& name) {
  return {{H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
           "create the group " + path_of(name)},
          path_of(name)};
}

Hdf5Group Hdf5Group::group(const std::string& name) const {
  return {{H5Gopen2(id(), name.c_str(), H5P_DEFAULT), H5Gclose, "open the group " + path_of(name)},
          path_of(name)};
}

template <Hdf5Number T>
Hdf5Data Hdf5Group::create_data(const std::string& name, const Hdf5Shape& shape) {
  const auto what = "create the data set " + path_of(name);
  const auto space = create_space(shape, what);
  const auto properties = creation_properties(shape, what);
  return {{H5Dcreate2(id(), name.c_str(), TypeOf<T>::stored(), space.id(), H5P_DEFAULT,
                      properties.id(), H5P_DEFAULT),
           H5Dclose, what},
          path_of(name)};
}

Hdf5Data Hdf5Group::data(const std::string& name) const {
  return {
      {H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose, "open the data set " + path_of(name)},
      path_of(name)};
}

void Hdf5Group::write_text(const std::string& name, std::string_view text) {
  const auto what = "write the text " + path_of(name);
  write_new_data(id(), name, text_type(text.size()), scalar_space(), bytes_of(text), what);
}

void Hdf5Group::write_texts(const std::string& name, const std::vector<std::string>& texts) {
  const auto what = "write the texts " + path_of(name);
  std::size_t length = 1;
  for (const auto& text : texts) length = std::max(length, text.size());
  std::string padded(texts.size() * length, '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(&padded[i * length], length);
  write_new_data(id(), name, text_type(length), create_space({.rows = texts.size()}, what),
                 padded.data(), what);
}

std::string Hdf5Group::read_text(const std::string& name, std::size_t most_bytes) const {
  const auto what = "read the text " + path_of(name);
  const Hdf5Handle data(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose, what);
  const Hdf5Handle type(H5Dget_type(data.id()), H5Tclose, what);
  const Hdf5Handle space(H5Dget_space(data.id()), H5Sclose, what);
  check_scalar(space.id(), what);
  const std::size_t length = text_length(type.id(), what);
  if (length > most_bytes) throw Hdf5Error("cannot " + what + ": it is too long");
  std::string text(length, '\0');
  check_hdf5(H5Dread(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), what);
  return without_padding(text);
}

#define RIESEL_INSTANTIATE(T)                                                                      \
  template void Hdf5Object::set_attribute<T>(const std::string&, T);                               \
  template T Hdf5Object::attribute<T>(const std::string&) const;                                   \
  template void Hdf5Data::write<T>(std::span<const T>);                                            \
  template void Hdf5Data::read<T>(std::span<T>) const;                                             \
  template void Hdf5Data::append<T>(std::span<const T>);                                           \
  template Hdf5Data Hdf5Group::create_data<T>(const std::string&, const Hdf5Shape&);
RIESEL_INSTANTIATE(std::int32_t)
RIESEL_INSTANTIATE(std::int64_t)
RIESEL_INSTANTIATE(std::uint64_t)
RIESEL_INSTANTIATE(double)
#undef RIESEL_INSTANTIATE

}  // namespace riesel::io
