// Appointments by the step in which they are due: a ring of buckets.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

class Calendar {
public:
  /// How far ahead an appointment can be made; later ones are to be moved to the horizon.
  static constexpr std::int64_t horizon = 1024;  // steps

  Calendar() : buckets_(horizon) {}

  /// now < due < now + horizon
  void enter(std::uint32_t appointment, std::int64_t due) { bucket(due).push_back(appointment); }

  /// The appointments of this step, which leave the calendar.
  const std::vector<std::uint32_t>& due_in(std::int64_t step) {
    today_.clear();
    today_.swap(bucket(step));
    return today_;
  }

  void clear() {
    for (auto& bucket : buckets_) bucket.clear();
  }

private:
  std::vector<std::uint32_t>& bucket(std::int64_t step) {
    return buckets_[static_cast<std::size_t>(step) % static_cast<std::size_t>(horizon)];
  }

  std::vector<std::vector<std::uint32_t>> buckets_;
  std::vector<std::uint32_t> today_;
};

}  // namespace riesel
