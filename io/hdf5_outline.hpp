// The outline of an HDF5 file: its groups, attributes and data sets, made as bytes, without the
// elements of the data sets, which are elsewhere in the file.
//
// HDF5's library changes a growing file in many places, and a kill between two of these writes can
// destroy the file. A program that makes the outline itself can put a new one beside the old one
// and switch over by a single write (see trajectory_file.hpp). As in hdf5_header.hpp, only the
// small classic part of the format is implemented that is needed here.
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

/// Most bytes of an attribute, with its name and its type: a header gives the size of each of its
/// messages in 16 bits, and as a multiple of 8.
inline constexpr std::size_t hdf5_largest_message = 65528;

/// The attributes of a group or a data set. add() throws Hdf5Error for one that is too large.
class Hdf5Attributes {
public:
  Hdf5Attributes& add(const std::string& name, std::string_view text);
  Hdf5Attributes& add(const std::string& name, std::int64_t number);
  Hdf5Attributes& add(const std::string& name, std::initializer_list<std::int32_t> numbers);
  /// A list of texts, padded to the length of the longest.
  Hdf5Attributes& add(const std::string& name, std::initializer_list<std::string_view> texts);

  /// Makes the data set a scale, by which others name their dimensions. Without values of its own
  /// it stands for a dimension only.
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
  /// Address of the elements in one piece; 0: none are stored, all equal `fill`.
  std::uint64_t piece = 0;
  /// If not 0, the data set is cut along its first dimension into chunks of this many rows, and may
  /// grow. Chunks without an address are filled with `fill`.
  std::uint64_t rows_per_chunk = 0;
  std::span<const std::uint64_t> chunks = {};  ///< addresses
  double fill = 0.0;                           ///< for real32 only
  Hdf5Attributes attributes = {};
  std::vector<Hdf5Scale> scales = {};  ///< one for each dimension, or none
};

/// Throws Hdf5Error if its limits are exceeded.
class Hdf5Outline {
public:
  static constexpr std::size_t most_members = 1024;    ///< of a group: its tree is a single node
  static constexpr std::size_t most_references = 169;  ///< in one heap

  /// `address`: where the outline will begin in the file, a multiple of 8.
  explicit Hdf5Outline(std::uint64_t address) : address_(address) {}

  /// Elements, if they are few. Members that add something return its address.
  std::uint64_t add_elements(std::string_view bytes);
  std::uint64_t add_data(const Hdf5DataPlan& plan);
  /// `members`: addresses by name; an object may have a name in each of several groups.
  std::uint64_t add_group(const std::map<std::string, std::uint64_t>& members,
                          const Hdf5Attributes& attributes = {});
  /// `data_sets`: addresses of the scales.
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
