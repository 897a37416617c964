// The choice between ways to step, with times made up.
#include "engine/stepping_choice.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

using riesel::SteppingChoice;
using riesel::Way;

namespace {

constexpr double preparation = 0.01;  // s
constexpr std::int64_t steps = 1000;

constexpr Way flights{.by_flights = true, .threads = 1};
constexpr Way plain{.by_flights = false, .threads = 1};
constexpr Way plain_on_two{.by_flights = false, .threads = 2};
const std::vector<Way> all{flights, plain_on_two, plain};

struct Account {
  double best = 0.0, spent = 0.0;  // s
  int changes = 0;
};

/// Steps for so long; a piece takes seconds(way, time).
Account follow(SteppingChoice& choice, double duration,
               const std::function<double(Way, double)>& seconds) {
  Account account;
  Way last = choice.way();
  while (account.spent < duration) {
    const Way way = choice.way();
    const double change = way == last ? 0.0 : preparation;
    const double piece = seconds(way, account.spent);
    double best = piece;
    for (const Way& other : all) best = std::min(best, seconds(other, account.spent));
    account.best += best;
    account.spent += piece + change;
    choice.note(steps, piece, change);
    account.changes += way == last ? 0 : 1;
    last = way;
  }
  return account;
}

}  // namespace

TEST_CASE("the fastest way is found, whatever was tried first") {
  std::vector<Way> ways = all;
  std::swap(ways.front(), ways[GENERATE(0U, 1U, 2U)]);
  const Way fastest = all[GENERATE(0U, 1U, 2U)];
  SteppingChoice choice(ways);
  const Account account =
      follow(choice, 100.0, [&](Way way, double) { return way == fastest ? 0.02 : 0.08; });
  CHECK(account.spent < 1.05 * account.best);
}

TEST_CASE("each way is tried twice at the beginning, between two pieces of the preferred one") {
  SteppingChoice choice(all);
  std::vector<Way> done;
  for (int piece = 0; piece < 10; ++piece) {
    done.push_back(choice.way());
    CHECK(choice.past_first_looks() == (piece >= 8));
    choice.note(steps, choice.way() == flights ? 0.010 : 0.014, 0.0);
  }
  CHECK(done
        == std::vector{flights, plain_on_two, flights, plain, flights, plain_on_two, flights, plain,
                       flights, flights});
  CHECK(choice.preferred() == flights);
}

TEST_CASE(
    "a way that is much slower is tried once at the beginning, one much faster taken at once") {
  SteppingChoice choice(all);
  std::vector<Way> done;
  for (int piece = 0; piece < 7; ++piece) {
    done.push_back(choice.way());
    const double pace = choice.way() == flights ? 0.030 : choice.way() == plain ? 0.014 : 0.010;
    choice.note(steps, pace, 0.0);
  }
  CHECK(done
        == std::vector{flights, plain_on_two, plain_on_two, plain, plain_on_two, plain,
                       plain_on_two});
  CHECK(choice.preferred() == plain_on_two);
}

TEST_CASE("after the beginning one moment in which another way is much faster is not enough") {
  SteppingChoice choice(all);
  int pieces = 0, trials = 0;
  while (trials < 40) {
    const bool of_preferred = choice.way() == flights;
    ++pieces;
    if (!of_preferred) ++trials;
    const bool late = pieces > 20;
    const bool good_moment = late && !of_preferred && trials % 3 == 0;
    choice.note(steps, good_moment ? 0.005 : of_preferred ? 0.010 : 0.014, 0.0);
    CHECK(choice.preferred() == flights);
  }
}

TEST_CASE("a way whose first trial falls into a bad moment is found all the same") {
  SteppingChoice choice(all);
  int trials = 0;
  for (int piece = 0; piece < 12; ++piece) {
    const bool is_fastest = choice.way() == plain;
    const bool bad_moment = is_fastest && ++trials == 1;
    choice.note(steps, is_fastest && !bad_moment ? 0.01 : 0.02, 0.0);
  }
  CHECK(choice.preferred() == plain);
}

TEST_CASE("the preferred way is not given up for one bad moment") {
  SteppingChoice choice(all);
  std::vector<Way> tried;
  for (int piece = 0; tried.size() < 40; ++piece) {
    const bool of_preferred = choice.way() == flights;
    if (!of_preferred) tried.push_back(choice.way());
    const bool bad_moment = of_preferred && piece % 7 == 0;
    const double seconds = bad_moment ? 0.03 : of_preferred ? 0.01 : 0.02;
    choice.note(steps, seconds, 0.0);
    CHECK(choice.preferred() == flights);
  }
}

TEST_CASE("it is known how fast each way was the last time") {
  SteppingChoice choice({flights, plain});
  CHECK(choice.pace() == 0.0);
  choice.note(1000, 0.010, preparation);
  REQUIRE(choice.way() == plain);
  CHECK(choice.pace() == 0.0);
  choice.note(500, 0.007, preparation);
  REQUIRE(choice.way() == flights);
  CHECK(choice.pace() == Approx(0.010 / 1000));
  choice.note(2000, 0.018, preparation);
  REQUIRE(choice.way() == plain);
  CHECK(choice.pace() == Approx(0.007 / 500));
}

TEST_CASE("where there is one way, no other is tried") {
  SteppingChoice choice({plain_on_two});
  CHECK_FALSE(choice.open());
  const Account account = follow(choice, 100.0, [](Way, double) { return 0.02; });
  CHECK(account.changes == 0);
  CHECK(choice.way() == plain_on_two);
}

TEST_CASE("trials of a way that is much slower cost little") {
  SteppingChoice choice(all);
  const Account account =
      follow(choice, 1000.0, [](Way way, double) { return way.by_flights ? 0.002 : 0.2; });
  CHECK(account.spent < 1.05 * account.best);
}

TEST_CASE("a change of the state is noticed") {
  SteppingChoice choice(all);
  const Account account = follow(choice, 600.0, [](Way way, double time) {
    return way.by_flights == (time < 200.0) ? 0.02 : 0.06;
  });
  CHECK(account.spent < 1.25 * account.best);
}

TEST_CASE("two threads are given up when another program takes their core") {
  SteppingChoice choice({plain_on_two, plain});
  const Account account = follow(choice, 600.0, [](Way way, double time) {
    if (way == plain) return 0.04;
    return time < 100.0 ? 0.02 : 0.5;
  });
  CHECK(choice.way() == plain);
  CHECK(account.spent < 1.2 * account.best);
}

TEST_CASE("ways that are equally fast are not exchanged all the time") {
  SteppingChoice choice(all);
  const Account account = follow(choice, 100.0, [](Way, double) { return 0.02; });
  CHECK(account.changes < 30);
}
