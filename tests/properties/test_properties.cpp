// A few random set-ups and impacts; docs/reliability.md tells of the thousands.
#include "tests/catch.hpp"
#include "tests/io/file_fixture.hpp"
#include "tests/properties/properties.hpp"

using namespace properties;

TEST_CASE("random set-ups come to the same bits by all ways, and their balances hold") {
  const file_fixture::ScratchDirectory scratch;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const SetUp set_up = random_set_up(seed);
    INFO("seed " << seed << ": " << description(set_up));
    const Outcome expected = reference(set_up);
    for (const Complaints& complaints :
         {same_bits(set_up, expected, seed, scratch.path()), balances(set_up, expected)})
      for (const std::string& complaint : complaints) FAIL_CHECK(complaint);
  }
}

TEST_CASE("random flows come to the same bits by windows") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const SetUp flow = random_flow(seed);
    INFO("seed " << seed << ": " << description(flow));
    const Complaints complaints = same_by_windows(flow, reference(flow), 1);
    CAPTURE(complaints);
    CHECK(complaints.empty());
  }
}

TEST_CASE("no impact wins energy but by the error of the time step") {
  // Second order. Of a million there are some that win more: docs/reliability.md.
  for (std::uint64_t seed = 1; seed <= 5000; ++seed) {
    const Impact impact = random_impact(seed);
    const double steps = impact.steps_per_contact;
    INFO("seed " << seed << ", " << steps << " steps per contact");
    CHECK(impact.gain < 3.0 / (steps * steps));
  }
}
