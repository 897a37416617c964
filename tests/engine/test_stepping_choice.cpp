// The choice between plain stepping and flights, with times made up.
#include "engine/stepping_choice.hpp"
#include "tests/catch.hpp"

#include <functional>

using riesel::SteppingChoice;

namespace {

constexpr double preparation = 0.01;  // s
constexpr std::int64_t steps = 1000;

struct Account {
  double best = 0.0, spent = 0.0;  // s
  int changes = 0;
};

/// Steps for so long; a piece takes seconds(by_flights, time).
Account follow(SteppingChoice& choice, double duration,
               const std::function<double(bool, double)>& seconds) {
  Account account;
  bool last = choice.by_flights();
  while (account.spent < duration) {
    const bool by_flights = choice.by_flights();
    const double change = by_flights == last ? 0.0 : preparation;
    const double piece = seconds(by_flights, account.spent);
    account.best += std::min(seconds(true, account.spent), seconds(false, account.spent));
    account.spent += piece + change;
    choice.note(steps, piece, change);
    account.changes += by_flights == last ? 0 : 1;
    last = by_flights;
  }
  return account;
}

}  // namespace

TEST_CASE("the faster way is found, whatever was tried first") {
  const bool first = GENERATE(true, false);
  const bool faster = GENERATE(true, false);
  SteppingChoice choice(first);
  const Account account = follow(
      choice, 100.0, [&](bool by_flights, double) { return by_flights == faster ? 0.02 : 0.08; });
  CHECK(account.spent < 1.05 * account.best);
}

TEST_CASE("trials of a way that is much slower cost little") {
  SteppingChoice choice(true);
  const Account account =
      follow(choice, 1000.0, [](bool by_flights, double) { return by_flights ? 0.002 : 0.2; });
  CHECK(account.spent < 1.05 * account.best);
}

TEST_CASE("a change of the state is noticed") {
  SteppingChoice choice(true);
  const Account account = follow(choice, 600.0, [](bool by_flights, double time) {
    return by_flights == (time < 200.0) ? 0.02 : 0.06;
  });
  CHECK(account.spent < 1.25 * account.best);
}

TEST_CASE("two ways that are equally fast are not exchanged all the time") {
  SteppingChoice choice(true);
  const Account account = follow(choice, 100.0, [](bool, double) { return 0.02; });
  CHECK(account.changes < 30);
}
