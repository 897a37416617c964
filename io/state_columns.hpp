// The lists of a State in HDF5: one data set per member, so that any HDF5 reader understands them.
#pragma once

#include "engine/state.hpp"
#include "io/hdf5_object.hpp"
#include "io/state_layout.hpp"
#include "io/stored_hdf5.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace riesel::io {

/// Writes numbers with their unit, in rows of `components` numbers.
template <Hdf5Number T>
Hdf5Data write_column(Hdf5Group& group, const std::string& name, const std::string& unit,
                      std::span<const T> values, std::size_t components = 1) {
  auto data =
      group.create_data<T>(name, {.rows = values.size() / components, .columns = components});
  data.write(values);
  data.set_attribute("unit", unit);
  return data;
}

/// Throws Hdf5Error.
[[noreturn]] inline void refuse_size(const std::string& name) {
  throw Hdf5Error("cannot read the data set " + name + ": its size is impossible");
}

/// Reads what write_column() wrote, into a vector. Throws Hdf5Error.
template <class Vector>
void read_column(const StoredGroup& group, const std::string& name, Vector& values) {
  using T = typename Vector::value_type;
  const auto data = group.data(name);
  const auto shape = data.shape();
  if (shape.columns != 1) refuse_size(name);
  values.resize(shape.rows);
  data.read(std::span<T>(values));
}

/// Exact sums are stored as rows of two integers: the upper 64 bits, and the lower ones as if
/// signed.
void write_column(Hdf5Group& group, const std::string& name, const std::string& unit,
                  const std::vector<ExactSum>& sums);
void read_column(const StoredGroup& group, const std::string& name, std::vector<ExactSum>& sums);

/// Writes each member of all records (contacts, visits or walls) as a column.
template <class Record>
void write_records(Hdf5Group& group, const std::vector<Record>& records) {
  for_each_member<Record>([&](const char* name, const char* unit, auto member) {
    using T = std::remove_cvref_t<decltype(member(records.front()))>;
    std::vector<T> values(records.size());
    for (std::size_t i = 0; i < records.size(); ++i) values[i] = member(records[i]);
    if constexpr (std::is_same_v<T, ExactSum>)
      write_column(group, name, unit, values);
    else
      write_column<T>(group, name, unit, values);
  });
}

/// Reads what write_records() wrote. Throws Hdf5Error as read_column().
template <class Record>
std::vector<Record> read_records(const StoredGroup& group) {
  std::vector<Record> records;
  bool first = true;
  for_each_member<Record>([&](const char* name, const char*, auto member) {
    std::vector<std::remove_cvref_t<decltype(member(records.front()))>> values;
    read_column(group, name, values);
    if (first) records.resize(values.size());
    first = false;
    if (values.size() != records.size()) {
      throw Hdf5Error(std::string("the data set ") + name + " is not as long as the others");
    }
    for (std::size_t i = 0; i < records.size(); ++i) member(records[i]) = values[i];
  });
  return records;
}

}  // namespace riesel::io
