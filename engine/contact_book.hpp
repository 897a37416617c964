// Keeps the contacts of one slice alive from step to step.
//
// The search meets contacts in the same order in every step, so that two ordered lists, those of
// the last step and those met in this one, are merged as the step goes: what stands in both goes
// on, what is only in the new one begins, what is only in the old one has ended. No look-up, no
// cost per pair that does not touch.
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
    std::uint64_t key;    ///< the place of the contact in the order of the search
    std::uint32_t place;  ///< of the contact, see contact()
  };

  void begin_step() {
    last_.swap(now_);
    now_.clear();
    next_ = 0;
  }

  /// The contact with this key, and whether it has just begun. Keys must increase within a step.
  std::pair<Contact&, bool> meet(std::uint64_t key, Tally& tally) {
    while (next_ < last_.size() && last_[next_].key < key) end(last_[next_++], tally);
    const bool goes_on = next_ < last_.size() && last_[next_].key == key;
    const std::uint32_t place = goes_on ? last_[next_++].place : room();
    now_.push_back({key, place});
    return {contacts_[place], !goes_on};
  }

  void end_step(Tally& tally) {
    while (next_ < last_.size()) end(last_[next_++], tally);
  }

  /// The lasting contacts, ordered by key.
  const std::vector<Entry>& entries() const { return now_; }
  const Contact& contact(const Entry& entry) const { return contacts_[entry.place]; }

  void clear() {
    now_.clear();
    contacts_.clear();
    free_.clear();
  }
  /// Keys must increase.
  void add(std::uint64_t key, const Contact& contact) {
    now_.push_back({key, static_cast<std::uint32_t>(contacts_.size())});
    contacts_.push_back(contact);
  }

private:
  std::uint32_t room() {
    if (free_.empty()) {
      contacts_.emplace_back();
      return static_cast<std::uint32_t>(contacts_.size() - 1);
    }
    const std::uint32_t place = free_.back();
    free_.pop_back();
    contacts_[place] = {};
    return place;
  }

  void end(const Entry& entry, Tally& tally) {
    tally.end(contacts_[entry.place]);
    free_.push_back(entry.place);
  }

  std::vector<Entry> last_, now_;
  std::size_t next_ = 0;  // first entry of last_ not yet met in this step
  std::vector<Contact> contacts_;
  std::vector<std::uint32_t> free_;  // places in contacts_
};

}  // namespace riesel
