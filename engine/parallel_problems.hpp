// Many small problems, each solved by one thread, side by side.
#pragma once

#include "engine/require.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <type_traits>
#include <vector>

namespace riesel {

/// The results of solve(problem) for all problems, in their order; on at most `threads` threads.
/// solve() must be safe to call from several threads. Throws std::invalid_argument
/// without a thread; when all have been tried, what the first problem that failed, in this order,
/// threw.
template <class Problem, class Solve>
auto solve_all(const std::vector<Problem>& problems, int threads, Solve solve) {
  require(threads > 0, "problems need a thread");
  std::vector<std::invoke_result_t<Solve, const Problem&>> solutions(problems.size());
  std::exception_ptr failure;
  std::size_t failed = problems.size();
  const auto useful = static_cast<std::size_t>(threads);
  const int team = static_cast<int>(std::clamp<std::size_t>(problems.size(), 1, useful));
#pragma omp parallel for schedule(dynamic) num_threads(team)
  for (std::size_t i = 0; i < problems.size(); ++i) {
    try {
      solutions[i] = solve(problems[i]);
    } catch (...) {
#pragma omp critical
      if (i < failed) {
        failed = i;
        failure = std::current_exception();
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
  return solutions;
}

}  // namespace riesel
