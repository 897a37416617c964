// A list that grows without branches, which could be mispredicted: each item that may belong to it
// is written behind its end, and the end moves on only if it does belong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace riesel {

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
