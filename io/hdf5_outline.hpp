// The outline of an HDF5 file: its groups, attributes and data sets, made as bytes, without the
// elements of the data sets, which stand elsewhere in the file.
//
// HDF5's library changes a file that grows at many places, and a kill between two of these writes
// can cost the file. Who makes the outline himself can put a new one beside the old one and change
// over by a single write (see trajectory_file.hpp). As in hdf5_header.hpp, of the format only the
// small classic part is known that is needed here.
//
// https://docs.hdfgroup.org/hdf5/v1_14/_f_m_t3.html
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace riesel::io {

enum class Hdf5Element { int32, int64, real32, real64, character };

/// Bytes of an element.
std::uint64_t size_of(Hdf5Element element);

/// Bytes of an attribute, with its name and its type: what a header holds of one thing is counted
/// by 16 bits, and rounded up to multiples of 8.
inline constexpr std::size_t hdf5_largest_message = 65528;

/// The attributes of a group or a data set. Those that are too large throw Hdf5Error.
class Hdf5Attributes {
public:
  Hdf5Attributes& add(const std::string& name, std::string_view text);
  Hdf5Attributes& add(const std::string& name, std::int64_t number);
  Hdf5Attributes& add(const std::string& name, std::initializer_list<std::int32_t> numbers);
  /// A list of texts, padded to the length of the longest.
  Hdf5Attributes& add(const std::string& name, std::initializer_list<std::string_view> texts);

  /// What makes a data set a scale, by which others name their dimensions. Without values of its
  /// own it stands for a dimension only.
  Hdf5Attributes& add_scale(const std::string& name, bool has_values);

private:
  friend class Hdf5Outline;
  void add(const std::string& name, const std::string& type, std::span<const std::uint64_t> extent,
           const std::string& value);

  std::vector<std::string> messages_;
};

/// A scale as data sets refer to it.
struct Hdf5Scale {
  std::uint64_t heap;  ///< address
  std::uint32_t index;
};

struct Hdf5DataPlan {
  Hdf5Element element = Hdf5Element::real64;
  std::vector<std::uint64_t> extent = {};
  /// Where the elements stand in one piece; 0: nowhere, all are as `fill` says.
  std::uint64_t piece = 0;
  /// Not 0: the data set is cut along its first dimension into chunks of so many rows, and may
  /// grow. Chunks that have no address are as `fill` says.
  std::uint64_t rows_per_chunk = 0;
  std::span<const std::uint64_t> chunks = {};  ///< addresses
  double fill = 0.0;                           ///< of real32 only
  Hdf5Attributes attributes = {};
  std::vector<Hdf5Scale> scales = {};  ///< one for each dimension, or none
};

/// Throws Hdf5Error for what is beyond its limits.
class Hdf5Outline {
public:
  static constexpr std::size_t most_members = 1024;    ///< of a group: its tree is a single node
  static constexpr std::size_t most_references = 169;  ///< in one heap

  /// `address`: where the outline will begin in the file, a multiple of 8.
  explicit Hdf5Outline(std::uint64_t address) : address_(address) {}

  /// Elements that are few. Members that add something return its address.
  std::uint64_t add_elements(std::string_view bytes);
  std::uint64_t add_data(const Hdf5DataPlan& plan);
  /// `members`: addresses by name; what stands in two groups has two names.
  std::uint64_t add_group(const std::map<std::string, std::uint64_t>& members,
                          const Hdf5Attributes& attributes = {});
  /// `data_sets`: addresses of those that are scales.
  std::vector<Hdf5Scale> add_references(std::span<const std::uint64_t> data_sets);

  const std::string& bytes() const { return bytes_; }

private:
  std::uint64_t add(std::string_view bytes);
  std::uint64_t add_header(const std::vector<std::string>& messages);
  std::uint64_t add_chunk_tree(const Hdf5DataPlan& plan);
  std::string layout_message(const Hdf5DataPlan& plan);

  std::uint64_t address_;
  std::string bytes_;
};

inline constexpr std::size_t hdf5_superblock_size = 96;  ///< bytes

/// The first bytes of a file: where its root group is, and where it ends.
std::string hdf5_superblock(std::uint64_t root, std::uint64_t end_of_file);

}  // namespace riesel::io
