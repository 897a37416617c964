#include "io/seal.hpp"

#include "engine/hash.hpp"
#include "io/bytes.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cstdint>

namespace riesel::io {
namespace {

/// The first line of the seal.
std::string title(std::string_view kind) { return fmt::format("riesel {}\n", kind); }

std::string_view text_of(std::span<const char> image) { return {image.data(), image.size()}; }

std::span<const char> behind_block(std::span<const char> image) { return image.subspan(seal_size); }

/// All that seals of riesel 0.10 and before said.
std::string without_crc(std::span<const char> image, std::string_view kind) {
  Hash checksum;
  checksum.add_text(text_of(behind_block(image)));
  return fmt::format("{}An HDF5 file behind a block of {} bytes\n"
                     "bytes in all: {}\n"
                     "FNV-1a of those behind the block: {:016x}\n",
                     title(kind), seal_size, image.size(), checksum.value());
}

std::string crc_line(std::span<const char> image) {
  const auto bytes = behind_block(image);
  const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  return fmt::format("CRC-32 of those behind the block: {:08x}\n", crc);
}

std::string filling_the_block(std::string text) {
  text.resize(seal_size, '\0');
  return text;
}

bool is_sealed(std::span<const char> image, std::string_view kind) {
  const auto earlier = without_crc(image, kind);
  const auto block = text_of(image.first(seal_size));
  return block == filling_the_block(earlier + crc_line(image))
         || block == filling_the_block(earlier);
}

}  // namespace

void seal(std::span<char> image, std::string_view kind) {
  filling_the_block(without_crc(image, kind) + crc_line(image)).copy(image.data(), seal_size);
}

std::string flaw_of_seal(std::span<const char> image, std::string_view kind) {
  if (!text_of(image).starts_with(title(kind)))
    return fmt::format("it does not begin like a {} of riesel", kind);
  const bool is_long_enough = image.size() >= seal_size;
  if (is_long_enough && checksums_are_forged) return "";
  return is_long_enough && is_sealed(image, kind) ? "" : "its length or checksum is wrong";
}

}  // namespace riesel::io
