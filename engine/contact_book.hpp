// Keeps the contacts of one slice alive from step to step.
//
// The search meets contacts in the same order in every step, so that two ordered lists, those of the last
// step and those met in this one, are merged as the step goes: what stands in both goes on, what is only in the new one
// begins, what is only in the old one has ended. No look-up, no cost per pair that does not touch.
#pragma once

#include "engine/contact.hpp"
#include "engine/tally.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace riesel {

class ContactBook {
 public:
  struct Entry {
    std::uint64_t key;  ///< the place of the contact in the order of the search
    Contact contact;
  };

  void begin_step() {
    last_.swap(now_);
    now_.clear();
    next_ = 0;
  }

  /// The contact with this key, and whether it has just begun. Keys must increase within a step.
  std::pair<Contact&, bool> meet(std::uint64_t key, Tally& tally) {
    while (next_ < last_.size() && last_[next_].key < key) end(last_[next_++].contact, tally);
    const bool goes_on = next_ < last_.size() && last_[next_].key == key;
    if (goes_on)
      now_.push_back(last_[next_++]);
    else
      now_.push_back({key, {}});
    return {now_.back().contact, !goes_on};
  }

  void end_step(Tally& tally) {
    while (next_ < last_.size()) end(last_[next_++].contact, tally);
  }

  const std::vector<Entry>& entries() const { return now_; }

  /// Replaces all contacts; `entries` must be ordered by key.
  void replace(std::vector<Entry> entries) { now_ = std::move(entries); }

 private:
  static void end(const Contact& contact, Tally& tally) {
    ContactTally& kind = tally.of(contact.name);
    ++kind.ended;
    kind.add(contact);
  }

  std::vector<Entry> last_, now_;
  std::size_t next_ = 0;  // first entry of last_ not yet met in this step
};

}  // namespace riesel
