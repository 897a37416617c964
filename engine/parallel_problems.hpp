// Many small problems, each of one thread, solved side by side.
#pragma once

#include <cstddef>
#include <exception>
#include <type_traits>
#include <vector>

namespace riesel {

/// solve(problem) for each of them, in their order, on `threads` threads: each as if alone. Throws
/// what the first of them threw, in this order.
template <class Problem, class Solve>
auto solve_all(const std::vector<Problem>& problems, int threads, Solve solve) {
  std::vector<std::invoke_result_t<Solve, const Problem&>> solutions(problems.size());
  std::exception_ptr failure;
  std::size_t failed = problems.size();
#pragma omp parallel for schedule(dynamic) num_threads(threads)
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
