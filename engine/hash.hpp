// 64-bit FNV-1a over the bytes of plain values: tells equal results from unequal ones, on machines
// of the same byte order. Not a cryptographic hash.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace riesel {

class Hash {
public:
  template <class T>
  void add(T value) {
    static_assert(std::is_arithmetic_v<T>);
    for (const auto byte : std::bit_cast<std::array<unsigned char, sizeof(T)>>(value))
      hash_ = (hash_ ^ byte) * 0x100000001b3U;
  }
  void add_text(std::string_view text) {
    for (const char c : text) add(c);
  }
  std::uint64_t value() const { return hash_; }

private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace riesel
