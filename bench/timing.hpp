// How long things take. Whatever is to be compared is measured in turns, A B C A B C ..., so that
// the noise of a shared machine hits all alike; the least of the repetitions is the best guess of
// what the machine can do, their median tells how far one may trust it.
#pragma once

#include <chrono>
#include <functional>
#include <vector>

namespace riesel::bench {

/// Does the work and returns what it took: s.
using Measurement = std::function<double()>;

/// What the repetitions of one measurement took.
struct Timing {
  std::vector<double> seconds;  ///< in the order in which they were done; never empty

  double least() const;
  double median() const;
};

/// Time on the clock that `work` takes: s.
template <class Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// One timing for each contender, their repetitions in turns.
std::vector<Timing> in_turns(const std::vector<Measurement>& contenders, int repetitions);

}  // namespace riesel::bench
