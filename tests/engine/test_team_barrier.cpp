// A barrier that lets one thread through too early, or forgets one, would show here.
#include "engine/team_barrier.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>
#include <vector>

using namespace riesel;

namespace {

/// What each member of a team has done, one cache line each.
struct alignas(cache_line) Rounds {
  int done = 0;
};

/// Each of `members` threads does `rounds` rounds with a barrier after each, with before(member,
/// round) on the way; returns how often one was seen ahead of or behind the others.
template <class Before>
int out_of_step(int members, int rounds, Before before) {
  TeamBarrier barrier(members);
  std::vector<Rounds> team(static_cast<std::size_t>(members));
  std::atomic<int> mismatches{0};
  const auto work = [&](int member) {
    const auto number = static_cast<std::size_t>(member);
    for (int round = 1; round <= rounds; ++round) {
      before(member, round);
      team[number].done = round;
      barrier.arrive_and_wait(number);
      mismatches += static_cast<int>(std::count_if(
          team.begin(), team.end(), [&](const Rounds& r) { return r.done != round; }));
      barrier.arrive_and_wait(number);
    }
  };
  std::vector<std::thread> threads;
  for (int member = 0; member < members; ++member) threads.emplace_back(work, member);
  for (std::thread& thread : threads) thread.join();
  return mismatches;
}

}  // namespace

TEST_CASE("a team stays in step") {
  const int members = GENERATE(1, 2, 3, 4);
  CHECK(out_of_step(members, 500, [](int, int) {}) == 0);
}

TEST_CASE("a member that comes late finds the others asleep and wakes them") {
  const int members = GENERATE(2, 4);
  const auto late = [&](int member, int round) {
    if (round % members == member) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  };
  CHECK(out_of_step(members, 20, late) == 0);
}

TEST_CASE("a member that has arrived can work on while the others pass") {
  TeamBarrier barrier(2);
  std::atomic<bool> passed{false};
  std::thread other([&] {
    barrier.arrive_and_wait(1);
    barrier.arrive(1);  // once more than the member that has not waited yet
    passed = true;
  });
  barrier.arrive(0);
  const auto give_up_at = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!passed && std::chrono::steady_clock::now() < give_up_at) std::this_thread::yield();
  CHECK(passed);
  barrier.wait(0);
  other.join();
}
