// Builds a string of bytes as file formats want them: numbers little-endian.
#pragma once

#include "io/bytes.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace riesel::io {

class ByteWriter {
public:
  /// Appends the lowest `width` bytes of the number, at most 8.
  ByteWriter& number(std::uint64_t value, std::size_t width) {
    for (std::size_t i = 0; i < width; ++i) bytes_.push_back(static_cast<char>(value >> (8 * i)));
    return *this;
  }
  ByteWriter& text(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  ByteWriter& zeros(std::size_t count) {
    bytes_.append(count, '\0');
    return *this;
  }
  /// Appends zeros up to a multiple of 8 bytes.
  ByteWriter& align() { return zeros(padded_to_8(bytes_.size()) - bytes_.size()); }

  const std::string& bytes() const { return bytes_; }

private:
  std::string bytes_;
};

/// The bytes of an array of numbers as they are in memory, which is how files hold them.
template <class Numbers>
std::string_view bytes_of(const Numbers& numbers) {
  static_assert(std::endian::native == std::endian::little);
  const auto bytes = std::as_bytes(std::span(numbers));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace riesel::io
