// Who of many is next: a tournament in which only the matches of those are played again whose time
// has changed.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace riesel::bench {

class Tournament {
public:
  explicit Tournament(std::size_t players)
      : leaves_(std::bit_ceil(players + 1)),
        times_(leaves_, std::numeric_limits<double>::infinity()),
        winners_(2 * leaves_) {
    for (std::size_t i = 0; i < leaves_; ++i) winners_[leaves_ + i] = static_cast<std::uint32_t>(i);
    for (std::size_t match = leaves_; match-- > 1;) play(match);
  }

  void set(std::size_t player, double time) {
    times_[player] = time;
    for (std::size_t match = (leaves_ + player) / 2; match > 0; match /= 2) play(match);
  }

  std::size_t first() const { return winners_[1]; }
  double time_of_first() const { return times_[first()]; }

private:
  void play(std::size_t match) {
    const std::uint32_t a = winners_[2 * match], b = winners_[2 * match + 1];
    winners_[match] = times_[b] < times_[a] ? b : a;
  }

  std::size_t leaves_;
  std::vector<double> times_;
  std::vector<std::uint32_t> winners_;  // of the match i between those of 2 i and 2 i + 1
};

}  // namespace riesel::bench
