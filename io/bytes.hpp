// A view of bytes that are not trusted: no request makes it read beyond their end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace riesel::io {

// A fuzzer should not have to guess checksums, which anyone who forges a file can make right: for
// it all of them count as right.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
inline constexpr bool checksums_are_forged = true;
#else
inline constexpr bool checksums_are_forged = false;
#endif

/// The least multiple of 8 that is at least `size`: where the next part of a file begins.
constexpr std::uint64_t padded_to_8(std::uint64_t size) { return (size + 7) / 8 * 8; }

/// The text without the zeros that fill it up to a fixed length.
inline std::string without_padding(std::string_view text) {
  return std::string(text.substr(0, text.find_last_not_of('\0') + 1));
}

/// Something beyond the end was asked for.
class OutOfBytes : public std::runtime_error {
public:
  OutOfBytes() : std::runtime_error("it points outside the file") {}
};

/// A view of bytes that are owned elsewhere. Numbers are little-endian. Members throw OutOfBytes.
class Bytes {
public:
  Bytes() = default;
  explicit Bytes(std::span<const char> bytes) : bytes_(bytes) {}

  std::size_t size() const { return bytes_.size(); }
  const char* data() const { return bytes_.data(); }

  Bytes from(std::uint64_t offset) const {
    if (offset > size()) throw OutOfBytes();
    return Bytes(bytes_.subspan(offset));
  }

  Bytes part(std::uint64_t offset, std::uint64_t length) const {
    const Bytes rest = from(offset);
    if (length > rest.size()) throw OutOfBytes();
    return Bytes(rest.bytes_.first(length));
  }

  /// The unsigned number of `width` bytes, at most 8, at `offset`.
  std::uint64_t number(std::uint64_t offset, std::size_t width) const {
    const Bytes digits = part(offset, width);
    std::uint64_t value = 0;
    for (std::size_t i = width; i-- > 0;)
      value = value << 8U | static_cast<unsigned char>(digits.bytes_[i]);
    return value;
  }

  std::string_view text() const { return {data(), size()}; }

private:
  std::span<const char> bytes_;
};

}  // namespace riesel::io
