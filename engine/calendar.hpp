// Appointments by the step in which they are due: a ring of buckets.
//
// A bucket is a chain of sheets from a common stock: so memory is needed for the largest number of
// appointments in the calendar at one time, not for the largest in each bucket.
#pragma once

#include "engine/aligned.hpp"
#include "engine/selection.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace riesel {

class Calendar {
public:
  /// Appointments can be made for less than this many steps ahead.
  static constexpr std::int64_t horizon = 1024;  // steps

  Calendar() : buckets_(horizon) {}

  /// Enters an appointment for step `due`: now <= due < now + horizon, and due_in(due) must not
  /// have been called yet.
  void enter(std::uint32_t appointment, std::int64_t due) {
    Bucket& to = bucket(due);
    const std::uint32_t on_last = to.count % Sheet::room;
    if (on_last == 0) to.last = new_sheet(to.last);
    sheets_[to.last].appointments[on_last] = appointment;
    ++to.count;
  }

  /// Removes the appointments of `step` and returns them. Must be called for every step, in order;
  /// the span is valid until the next call.
  std::span<const std::uint32_t> due_in(std::int64_t step) {
    Bucket& from = bucket(step);
    today_.clear();
    while (from.count > 0) {
      const Sheet& sheet = sheets_[from.last];
      const std::uint32_t on_it = (from.count - 1) % Sheet::room + 1;
      // A whole sheet, full or not: a constant length is copied by a few instructions.
      std::copy_n(sheet.appointments.begin(), Sheet::room, today_.room_for(Sheet::room));
      today_.take(on_it);
      from.count -= on_it;
      unused_.push_back(from.last);
      from.last = sheet.before;
    }
    return today_.items();
  }

  void clear() {
    std::fill(buckets_.begin(), buckets_.end(), Bucket{});
    sheets_.clear();
    unused_.clear();
  }

private:
  struct alignas(cache_line) Sheet {
    static constexpr std::uint32_t room = 15;  // so that it is one cache line

    std::array<std::uint32_t, room> appointments{};
    std::uint32_t before = 0;  // the previous sheet of its bucket
  };
  struct Bucket {
    std::uint32_t count = 0;  // of appointments: all sheets but the last are full
    std::uint32_t last = 0;   // sheet, if there are any
  };

  Bucket& bucket(std::int64_t step) {
    return buckets_[static_cast<std::size_t>(step) % static_cast<std::size_t>(horizon)];
  }

  std::uint32_t new_sheet(std::uint32_t before) {
    if (unused_.empty()) {
      unused_.push_back(static_cast<std::uint32_t>(sheets_.size()));
      sheets_.emplace_back();
    }
    const std::uint32_t sheet = unused_.back();
    unused_.pop_back();
    sheets_[sheet].before = before;
    return sheet;
  }

  std::vector<Bucket> buckets_;
  AlignedVector<Sheet> sheets_;
  std::vector<std::uint32_t> unused_;  // sheets
  Selection today_;
};

}  // namespace riesel
