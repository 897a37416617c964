#include "io/stored_hdf5.hpp"

#include "io/hdf5_handle.hpp"
#include "io/hdf5_trees.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

namespace riesel::io {
namespace {

template <class T>
constexpr Hdf5Type::Kind kind_of = Hdf5Type::Kind::text;
template <>
constexpr Hdf5Type::Kind kind_of<std::int32_t> = Hdf5Type::Kind::int32;
template <>
constexpr Hdf5Type::Kind kind_of<std::int64_t> = Hdf5Type::Kind::int64;
template <>
constexpr Hdf5Type::Kind kind_of<std::uint64_t> = Hdf5Type::Kind::uint64;
template <>
constexpr Hdf5Type::Kind kind_of<double> = Hdf5Type::Kind::real64;

/// Returns what `read` returns; its errors say what was attempted.
template <class Read>
auto attempt(const std::string& what, Read read) {
  try {
    return read();
  } catch (const std::runtime_error& error) {
    throw Hdf5Error("cannot " + what + ": " + error.what());
  }
}

/// The address of the root's header (superblock, version 0).
std::uint64_t find_root(const StoredBytes& bytes, std::size_t user_block) {
  using namespace std::string_view_literals;
  constexpr auto beginning = "\x89HDF\r\n\x1a\n\0\0\0\0\0\x08\x08\0"sv;
  require(bytes.content.from(0).text().starts_with(beginning),
          "it does not begin like an HDF5 file of this program");
  require(bytes.content.number(24, 8) == user_block, "it does not begin where it says");
  require(bytes.content.number(40, 8) == bytes.all.size(), "it has another length than it says");
  return bytes.content.number(64, 8);
}

}  // namespace

void StoredBytes::give(std::uint64_t size) {
  constexpr std::uint64_t copies = 16;  // reading all of a file takes two or three
  require(size <= copies * all.size() - given, "it shows the same bytes in too many places");
  given += size;
}

StoredObject::StoredObject(std::shared_ptr<StoredBytes> bytes, std::uint64_t address,
                           std::string path)
    : bytes_(std::move(bytes)),
      header_(attempt("open " + path,
                      [&] {
                        constexpr std::uint64_t about_a_header = 64;
                        auto header = read_hdf5_header(bytes_->content, address);
                        bytes_->give(about_a_header * (1 + header.attributes.size()));
                        return header;
                      })),
      path_(std::move(path)) {}

std::string StoredObject::reading(const std::string& name) const {
  return "read the attribute " + name + " of " + path_;
}

const Hdf5Attribute& StoredObject::single_value(const std::string& name) const {
  const auto found = header_.attributes.find(name);
  require(found != header_.attributes.end(), "it is missing");
  require(found->second.extent.empty(), "it is not a single value");
  return found->second;
}

template <Hdf5Number T>
T StoredObject::attribute(const std::string& name) const {
  return attempt(reading(name), [&] {
    const auto& stored = single_value(name);
    require(stored.type.kind == kind_of<T>, "it has another type");
    T value{};
    std::memcpy(&value, stored.value.part(0, sizeof value).data(), sizeof value);
    return value;
  });
}

std::string StoredObject::text_attribute(const std::string& name) const {
  return attempt(reading(name), [&] {
    const auto& stored = single_value(name);
    require(stored.type.kind == Hdf5Type::Kind::text, "it is not a text of fixed length");
    bytes_->give(stored.type.size);
    return without_padding(stored.value.part(0, stored.type.size).text());
  });
}

Hdf5Shape StoredData::shape() const {
  return attempt("read the shape of " + path(), [&] {
    require(header().type && header().layout && header().extent, "it is not a data set");
    const auto& extent = *header().extent;
    require(!extent.empty(), "it is not a table");
    const Hdf5Shape shape{.rows = extent[0], .columns = extent.size() == 2 ? extent[1] : 1};
    // The file has room for at most this many elements, so the sizes below cannot overflow.
    const auto most = bytes()->all.size() / header().type->size;
    require(shape.columns > 0 && shape.columns <= most, "its size is impossible");
    require(shape.rows <= most / shape.columns, "its size is impossible");
    return shape;
  });
}

template <Hdf5Number T>
void StoredData::read(std::span<T> values) const {
  const Hdf5Shape size = shape();
  attempt("read the data set " + path(), [&] {
    require(header().type->kind == kind_of<T>, "it has another type");
    require(values.size() == size.rows * size.columns, "the size does not match");
    bytes()->give(values.size_bytes());
    read_bytes({reinterpret_cast<char*>(values.data()), values.size_bytes()});
  });
}

void StoredData::read_bytes(std::span<char> memory) const {
  if (memory.empty()) return;
  const auto& layout = *header().layout;
  const auto& extent = *header().extent;
  require(layout.chunked && header().has_checksums, "it has no checksums");
  require(layout.chunk.size() == extent.size() + 1 && layout.chunk.back() == header().type->size,
          "its chunks have another shape");
  require(layout.chunk.front() > 0
              && std::equal(extent.begin() + 1, extent.end(), layout.chunk.begin() + 1),
          "its chunks have another shape");
  const auto row_size = memory.size() / extent.front();
  require(layout.chunk.front() <= file().size() / row_size, "its chunks are too large");
  const auto chunk_size = layout.chunk.front() * row_size;
  const auto chunks =
      read_hdf5_chunks(file(), layout, chunk_size, (memory.size() + chunk_size - 1) / chunk_size);
  for (const Bytes& chunk : chunks) {
    const auto size = std::min(chunk.size(), memory.size());
    std::copy_n(chunk.data(), size, memory.begin());
    memory = memory.subspan(size);
  }
}

StoredGroup::StoredGroup(std::shared_ptr<StoredBytes> bytes, std::uint64_t address,
                         std::string path)
    : StoredObject(std::move(bytes), address, std::move(path)) {
  members_ = attempt("open the group " + this->path(), [&] {
    require(header().members.has_value(), "it is not a group");
    auto members = read_hdf5_members(file(), *header().members);
    for (const auto& member : members) this->bytes()->give(member.first.size());
    return members;
  });
}

std::string StoredGroup::path_of(const std::string& name) const {
  return path().ends_with('/') ? path() + name : path() + '/' + name;
}

std::uint64_t StoredGroup::address_of(const std::string& name) const {
  return attempt("open " + path_of(name), [&] {
    const auto found = members_.find(name);
    require(found != members_.end(), "it is missing");
    return found->second;
  });
}

std::vector<std::string> StoredGroup::names() const {
  std::vector<std::string> names;
  for (const auto& [name, address] : members_) names.push_back(name);
  return names;
}

bool StoredGroup::is_group(const std::string& name) const {
  return data(name).header().members.has_value();
}

StoredGroup StoredGroup::group(const std::string& name) const {
  return {bytes(), address_of(name), path_of(name)};
}

StoredData StoredGroup::data(const std::string& name) const {
  return {bytes(), address_of(name), path_of(name)};
}

std::string StoredGroup::text(const std::string& name) const {
  const StoredData data = this->data(name);
  return attempt("read the text " + path_of(name), [&] {
    const Hdf5Header& header = data.header();
    require(header.type && header.layout && header.extent, "it is not a data set");
    require(header.type->kind == Hdf5Type::Kind::text, "it is not a text of fixed length");
    require(header.extent->empty(), "it is not a single value");
    require(!header.layout->chunked && header.layout->size == header.type->size,
            "it has a layout that is never written");
    bytes()->give(header.layout->size);
    return without_padding(file().part(header.layout->address, header.layout->size).text());
  });
}

StoredGroup stored_hdf5(std::vector<char> bytes, std::size_t user_block) {
  auto file = std::make_shared<StoredBytes>(StoredBytes{.all = std::move(bytes), .content = {}});
  const auto root = attempt("open the file", [&] {
    file->content = Bytes(file->all).from(user_block);
    return find_root(*file, user_block);
  });
  return {std::move(file), root, "/"};
}

#define RIESEL_INSTANTIATE(T)                                                                      \
  template T StoredObject::attribute<T>(const std::string&) const;                                 \
  template void StoredData::read<T>(std::span<T>) const;
RIESEL_INSTANTIATE(std::int32_t)
RIESEL_INSTANTIATE(std::int64_t)
RIESEL_INSTANTIATE(std::uint64_t)
RIESEL_INSTANTIATE(double)
#undef RIESEL_INSTANTIATE

}  // namespace riesel::io
