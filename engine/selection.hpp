// A list that grows without branches, which could be mispredicted: each item that may belong to it
// is written behind its end, and the end moves on only if it does belong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace riesel {

/// Writes first + k for each of the flags k that is 1, not 0, to `list`, which must have room for
/// `count` items; returns how many these are.
template <class Flag>
[[gnu::always_inline]] inline std::size_t list_flagged(const Flag* flags, std::size_t count,
                                                       std::size_t first, std::uint32_t* list) {
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k) {
    list[found] = static_cast<std::uint32_t>(first + k);
    found += static_cast<std::size_t>(flags[k]);
  }
  return found;
}

class Selection {
public:
  std::span<const std::uint32_t> items() const { return std::span(items_).first(size_); }

  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }
  void add(std::uint32_t item) {
    *room_for(1) = item;
    take(1);
  }
  /// Returns where `more` items may be written. take() then makes the first of them items.
  std::uint32_t* room_for(std::size_t more) {
    if (items_.size() < size_ + more) items_.resize(2 * (size_ + more));
    return items_.data() + size_;
  }
  void take(std::size_t more) { size_ += more; }
  /// Removes the items for which wanted(item) is false. wanted() must not change the selection.
  template <class Wanted>
  void keep_if(Wanted wanted) {
    std::size_t kept = 0;
    for (const std::uint32_t item : items()) {
      items_[kept] = item;
      kept += wanted(item) ? 1U : 0U;
    }
    size_ = kept;
  }

private:
  std::vector<std::uint32_t> items_;  // and room behind them
  std::size_t size_ = 0;
};

}  // namespace riesel
