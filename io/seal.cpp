#include "io/seal.hpp"

#include "engine/hash.hpp"
#include "io/bytes.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace riesel::io {
namespace {

/// The first line of the seal.
std::string title(std::string_view kind) { return fmt::format("riesel {}\n", kind); }

std::string_view text_of(std::span<const char> image) { return {image.data(), image.size()}; }

/// The seal of the whole file.
std::string seal_text(std::span<const char> image, std::string_view kind) {
  Hash checksum;
  checksum.add_text(text_of(image.subspan(seal_size)));
  auto text = fmt::format("{}An HDF5 file behind a block of {} bytes\n"
                          "bytes in all: {}\n"
                          "FNV-1a of those behind the block: {:016x}\n",
                          title(kind), seal_size, image.size(), checksum.value());
  text.resize(seal_size, '\0');
  return text;
}

}  // namespace

void seal(std::span<char> image, std::string_view kind) {
  seal_text(image, kind).copy(image.data(), seal_size);
}

std::string flaw_of_seal(std::span<const char> image, std::string_view kind) {
  if (!text_of(image).starts_with(title(kind)))
    return fmt::format("it does not begin like a {} of riesel", kind);
  const bool is_long_enough = image.size() >= seal_size;
  if (is_long_enough && checksums_are_forged) return "";
  const bool is_whole = is_long_enough && text_of(image).starts_with(seal_text(image, kind));
  return is_whole ? "" : "its length or checksum is wrong";
}

}  // namespace riesel::io
