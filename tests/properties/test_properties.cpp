// A few random set-ups and impacts; docs/reliability.md tells of the thousands.
#include "tests/catch.hpp"
#include "tests/io/file_fixture.hpp"
#include "tests/properties/properties.hpp"

#include <cmath>
#include <filesystem>
#include <variant>

using namespace properties;

namespace {

void complain_of(const SetUp& set_up, const Outcome& expected, std::uint64_t seed,
                 const std::filesystem::path& scratch) {
  for (const Complaints& complaints :
       {same_bits(set_up, expected, seed, scratch), balances(set_up, expected)})
    for (const std::string& complaint : complaints) FAIL_CHECK(complaint);
}

/// Whether nothing can take energy from grains that meet.
bool conserves_energy(const riesel::ContactModel& model) {
  const auto* linear = std::get_if<riesel::LinearLaw>(&model.normal);
  return linear != nullptr && linear->gamma_n == 0.0 && model.friction == 0.0
         && model.rolling_friction == 0.0;
}

}  // namespace

TEST_CASE("random set-ups come to the same bits by all ways, and their balances hold") {
  const file_fixture::ScratchDirectory scratch;
  int with_contacts = 0;
  for (std::uint64_t seed = 1; seed <= 90; ++seed) {
    const SetUp set_up = random_set_up(seed);
    INFO("seed " << seed << ": " << description(set_up));
    const Outcome expected = reference(set_up);
    CHECK(expected.failure.empty());
    const bool touching = contacts_begun(expected.end) > 0;
    if (touching) ++with_contacts;
    if (!touching && seed % 3 != 0) continue;  // nothing is asked of it but to fly
    complain_of(set_up, expected, seed, scratch.path());
  }
  CHECK(with_contacts >= 55);
}

TEST_CASE("random set-ups that have a reason to fail do so by all ways") {
  const file_fixture::ScratchDirectory scratch;
  for (const std::uint64_t seed : {161U, 171U, 423U, 609U, 676U}) {
    const SetUp set_up = random_set_up(seed);
    INFO("seed " << seed << ": " << description(set_up));
    const Outcome expected = reference(set_up);
    CHECK_FALSE(expected.failure.empty());
    complain_of(set_up, expected, seed, scratch.path());
  }
}

TEST_CASE("random flows come to the same bits by windows") {
  std::int64_t ended = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const SetUp flow = random_flow(seed);
    INFO("seed " << seed << ": " << description(flow));
    const Outcome expected = reference(flow);
    CHECK(expected.failure.empty());
    for (const riesel::ContactTally* kind :
         {&expected.end.tally.grains, &expected.end.tally.walls}) {
      CHECK(kind->ended > 150);
      ended += kind->ended;
    }
    const Complaints complaints = same_by_windows(flow, expected, 1);
    CAPTURE(complaints);
    CHECK(complaints.empty());
  }
  CHECK(ended > 10'000);
}

TEST_CASE("no impact wins energy but by the error of the time step") {
  // Second order. Of a million there are some that win more: docs/reliability.md.
  int touching = 0, losing = 0, conserving = 0;
  for (std::uint64_t seed = 1; seed <= 5000; ++seed) {
    const Impact impact = random_impact(seed);
    const double steps = impact.steps_per_contact;
    INFO("seed " << seed << ", " << steps << " steps per contact");
    CHECK(impact.gain < 3.0 / (steps * steps));
    CHECK(std::abs(impact.residual) < 60.0 / (steps * steps));
    if (impact.contacts == 0) continue;
    ++touching;
    if (impact.gain < -1e-3) ++losing;
    if (!conserves_energy(impact.model)) continue;
    ++conserving;
    CHECK(std::abs(impact.gain) < 3.0 / (steps * steps));
  }
  CHECK(touching > 4900);
  CHECK(losing > 4700);
  CHECK(conserving > 40);
}
