// The verdict and its thresholds.
#include "engine/validity.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <limits>
#include <string>

using namespace riesel;

namespace {

/// Evidence of grains as hard as one could wish.
constexpr Evidence hard = {.max_overlap_ratio = 0.01,
                           .brake_failure_fraction = 0.02,
                           .passages_per_visit = 0.01,
                           .wall_speed_ratio = 0.1,
                           .pulling_fraction = 0.05,
                           .steps_per_contact = 50.0,
                           .energy_error_ratio = 1e-4,
                           .limits_exceeded = 0.0,
                           .contact_rate_times_t_col = 0.01};

Validity verdict_with(double Evidence::*member, double value) {
  Evidence evidence = hard;
  evidence.*member = value;
  return judge(evidence).verdict;
}

}  // namespace

TEST_CASE("hard grains are valid, with all findings told") {
  const ValidityVerdict v = judge(hard);
  CHECK(v.verdict == Validity::valid);
  REQUIRE(v.findings.size() == 9);
  for (const Finding& finding : v.findings) CHECK(finding.verdict == Validity::valid);
  CHECK(v.findings[1].name == "brake_failure_fraction");
  CHECK(v.findings[1].value == hard.brake_failure_fraction);
}

TEST_CASE("impacts are judged by their overlaps, how they brake and how well energy is kept") {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto is = [](const Finding& finding, Validity verdict, std::string_view name) {
    return finding.verdict == verdict && finding.name == name;
  };
  const char* const overlap = "max_overlap_ratio";
  const char* const brake = "brake_failure_fraction";
  const char* const energy = "energy_error_ratio";
  CHECK(judge_impacts(0.19, 0.09, 0.009).verdict == Validity::valid);
  CHECK(is(judge_impacts(0.21, 0.09, 0.0), Validity::suspect, overlap));
  CHECK(is(judge_impacts(0.19, 0.11, 0.0), Validity::suspect, brake));
  CHECK(is(judge_impacts(0.19, 0.09, 0.011), Validity::suspect, energy));
  CHECK(is(judge_impacts(0.51, 0.11, 0.011), Validity::unphysical, overlap));
  CHECK(is(judge_impacts(0.21, 0.51, 0.0), Validity::unphysical, brake));
  CHECK(is(judge_impacts(0.19, 0.09, 0.11), Validity::unphysical, energy));
  CHECK(is(judge_impacts(0.19, unknown, 0.0), Validity::suspect, brake));
  CHECK(is(judge_impacts(0.51, 0.51, 0.11), Validity::unphysical, energy));
  CHECK(is(judge_impacts(0.51, 0.51, 0.0), Validity::unphysical, brake));
}

TEST_CASE("drops are judged by their overlap, by what hard beads would lose, and by their energy") {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  CHECK(judge_drop(0.19, -0.09, 0.009) == Validity::valid);
  CHECK(judge_drop(0.21, 0.0, 0.0) == Validity::suspect);
  CHECK(judge_drop(0.0, -0.11, 0.0) == Validity::suspect);
  CHECK(judge_drop(0.0, unknown, 0.0) == Validity::suspect);
  CHECK(judge_drop(0.0, 0.0, 0.011) == Validity::suspect);
  CHECK(judge_drop(0.51, 0.0, 0.0) == Validity::unphysical);
  CHECK(judge_drop(0.0, 0.51, 0.0) == Validity::unphysical);
  CHECK(judge_drop(0.0, 0.0, 0.11) == Validity::unphysical);
}

TEST_CASE("each threshold separates two verdicts") {
  struct Case {
    double Evidence::*member;
    double suspect, unphysical;
  };
  const Case c = GENERATE(Case{&Evidence::max_overlap_ratio, 0.2, 0.5},
                          Case{&Evidence::brake_failure_fraction, 0.1, 0.5},
                          Case{&Evidence::passages_per_visit, 0.5, 2.0},
                          Case{&Evidence::wall_speed_ratio, 0.5, 3.0},
                          Case{&Evidence::energy_error_ratio, 0.01, 0.1});
  CHECK(verdict_with(c.member, 0.99 * c.suspect) == Validity::valid);
  CHECK(verdict_with(c.member, 1.01 * c.suspect) == Validity::suspect);
  CHECK(verdict_with(c.member, 0.99 * c.unphysical) == Validity::suspect);
  CHECK(verdict_with(c.member, 1.01 * c.unphysical) == Validity::unphysical);
}

TEST_CASE("short contacts that brake next to nothing are no passages") {
  Evidence dense = hard;
  dense.brake_failure_fraction = 0.009;
  dense.passages_per_visit = 5.0;
  CHECK(judge(dense).verdict == Validity::valid);
  CHECK(judge(dense).findings[2].value == 5.0);
  dense.brake_failure_fraction = 0.011;
  CHECK(judge(dense).verdict == Validity::unphysical);
}

TEST_CASE("contacts that pull are never more than suspect") {
  CHECK(verdict_with(&Evidence::pulling_fraction, 0.14) == Validity::valid);
  CHECK(verdict_with(&Evidence::pulling_fraction, 0.16) == Validity::suspect);
  CHECK(verdict_with(&Evidence::pulling_fraction, 1.0) == Validity::suspect);
}

TEST_CASE("grains that meet others before they have separated are suspect, however soft") {
  CHECK(verdict_with(&Evidence::contact_rate_times_t_col, 0.49) == Validity::valid);
  CHECK(verdict_with(&Evidence::contact_rate_times_t_col, 0.51) == Validity::suspect);
  CHECK(verdict_with(&Evidence::contact_rate_times_t_col, 5.0) == Validity::suspect);
}

TEST_CASE("limits that were exceeded are suspect, however many") {
  CHECK(verdict_with(&Evidence::limits_exceeded, 1.0) == Validity::suspect);
  CHECK(verdict_with(&Evidence::limits_exceeded, 4.0) == Validity::suspect);
}

TEST_CASE("few steps are suspect and no proof") {
  CHECK(verdict_with(&Evidence::steps_per_contact, 1e6) == Validity::valid);
  CHECK(verdict_with(&Evidence::steps_per_contact, 9.9) == Validity::suspect);
  CHECK(verdict_with(&Evidence::steps_per_contact, 0.1) == Validity::suspect);
}

TEST_CASE("what is not known is suspect") {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  for (const auto member : {&Evidence::max_overlap_ratio, &Evidence::brake_failure_fraction,
                            &Evidence::passages_per_visit, &Evidence::wall_speed_ratio,
                            &Evidence::pulling_fraction, &Evidence::steps_per_contact,
                            &Evidence::energy_error_ratio, &Evidence::contact_rate_times_t_col})
    CHECK(verdict_with(member, unknown) == Validity::suspect);
}

TEST_CASE("the worst finding is the verdict, and says what to do") {
  Evidence evidence = hard;
  evidence.pulling_fraction = 0.3;
  evidence.brake_failure_fraction = 0.9;
  const ValidityVerdict v = judge(evidence);
  CHECK(v.verdict == Validity::unphysical);
  CHECK(std::string(v.findings[1].remedy).find("contact.stiffness") != std::string::npos);
  CHECK(v.findings[4].verdict == Validity::suspect);
}

TEST_CASE("verdicts have names") {
  CHECK(name(Validity::valid) == "valid");
  CHECK(name(Validity::suspect) == "suspect");
  CHECK(name(Validity::unphysical) == "unphysical");
  for (const Validity validity : {Validity::valid, Validity::suspect, Validity::unphysical})
    CHECK(validity_named(name(validity)) == validity);
  CHECK_FALSE(validity_named("good"));
}
