#include "bench/timing.hpp"

#include <algorithm>

namespace riesel::bench {

double Timing::least() const { return *std::min_element(seconds.begin(), seconds.end()); }

double Timing::median() const {
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

std::vector<Timing> in_turns(const std::vector<Measurement>& contenders, int repetitions) {
  std::vector<Timing> timings(contenders.size());
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (std::size_t i = 0; i < contenders.size(); ++i)
      timings[i].seconds.push_back(contenders[i]());
  return timings;
}

}  // namespace riesel::bench
