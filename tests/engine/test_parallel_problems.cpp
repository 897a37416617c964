// Small problems solved side by side: each as if alone, whatever others do.
#include "engine/parallel_problems.hpp"

#include "tests/catch.hpp"

#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

TEST_CASE("solutions stand in the order of their problems") {
  std::vector<int> problems(100);
  std::iota(problems.begin(), problems.end(), 0);
  const auto solutions = riesel::solve_all(problems, 3, [](int problem) { return 2 * problem; });
  for (std::size_t i = 0; i < problems.size(); ++i) CHECK(solutions[i] == 2 * problems[i]);
}

TEST_CASE("of several failures that of the first problem is told, whichever comes first") {
  const std::vector<int> problems = {0, 1, 2, 3};
  const auto solve = [](int problem) {
    if (problem == 1) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (problem > 0) throw std::runtime_error(std::to_string(problem));
    return problem;
  };
  for (const int threads : {1, 2, 4})
    CHECK_THROWS_WITH(riesel::solve_all(problems, threads, solve), "1");
}

TEST_CASE("problems without a thread are refused") {
  CHECK_THROWS_AS(riesel::solve_all(std::vector<int>{1}, 0, [](int problem) { return problem; }),
                  std::invalid_argument);
}
