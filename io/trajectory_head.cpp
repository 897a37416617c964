#include "io/trajectory_head.hpp"

#include "engine/hash.hpp"
#include "io/byte_writer.hpp"
#include "io/hdf5_handle.hpp"
#include "io/hdf5_outline.hpp"

#include <span>

namespace riesel::io {
namespace {

constexpr std::size_t title_place = 128;  // behind the superblock
constexpr std::string_view title = "riesel trajectory 3\n";
constexpr std::size_t numbers_place = title_place + 32;
constexpr std::size_t checksum_place = trajectory_head_size - 8;

/// Calls visit(number) for each number of the head, in the order of the file.
template <class AnyHead, class Visit>
void for_each_number(AnyHead& head, Visit visit) {
  auto& [run, grains, wall_grains, steps_per_frame, frames_per_block, frames, blocks, end, places,
         in_use, outline_size, outline_checksum] = head;
  for (auto* number :
       {&run, &grains, &wall_grains, &steps_per_frame, &frames_per_block, &frames, &blocks, &end})
    visit(*number);
  for (auto& [address, capacity] : places) visit(address), visit(capacity);
  for (auto* number : {&in_use, &outline_size, &outline_checksum}) visit(*number);
}

}  // namespace

std::uint64_t checksum_of(std::string_view bytes) {
  Hash hash;
  hash.add_text(bytes);
  return hash.value();
}

std::string written(const TrajectoryHead& head, std::uint64_t root) {
  ByteWriter bytes;
  bytes.text(hdf5_superblock(root, head.end)).zeros(title_place - hdf5_superblock_size);
  bytes.text(title).zeros(numbers_place - title_place - title.size());
  for_each_number(head, [&](std::uint64_t number) { bytes.number(number, 8); });
  bytes.zeros(checksum_place - bytes.bytes().size());
  return bytes.number(checksum_of(bytes.bytes()), 8).bytes();
}

TrajectoryHead read_trajectory_head(const Bytes& bytes) {
  require(bytes.part(title_place, title.size()).text() == title,
          "it is not a trajectory of riesel");
  require(checksums_are_forged
              || bytes.number(checksum_place, 8)
                     == checksum_of(bytes.part(0, checksum_place).text()),
          "its head is damaged");
  TrajectoryHead head;
  std::size_t place = numbers_place;
  for_each_number(head, [&](std::uint64_t& number) {
    number = bytes.number(place, 8);
    place += 8;
  });
  require(head.in_use < head.places.size(), "its head is damaged");
  return head;
}

}  // namespace riesel::io
