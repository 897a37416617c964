// Arrays that start on a cache line, so that vector loads never straddle two.
#pragma once

#include <cstddef>
#include <new>
#include <span>
#include <vector>

namespace riesel {

inline constexpr std::size_t cache_line = 64;  // bytes

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>&) {}

  T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{cache_line}));
  }
  void deallocate(T* p, std::size_t n) {
    ::operator delete (p, n * sizeof(T), std::align_val_t{cache_line});
  }
  template <class U>
  bool operator==(const CacheLineAllocator<U>&) const {
    return true;
  }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

/// Empties an array and frees its memory; `= {}` would keep it.
template <class Array>
void give_up(Array& array) {
  array = Array();
}

/// Loads values into the caches line by line, which is faster than in the random order in which
/// they will be needed. It reads them, because the processor drops most prefetches of so many
/// lines.
template <class T>
void fetch(std::span<T> values) {
  const auto bytes = std::as_bytes(values);
  for (std::size_t i = 0; i < bytes.size(); i += cache_line)
    static_cast<void>(*static_cast<const volatile std::byte*>(&bytes[i]));
}

}  // namespace riesel
