// The statistics of kept series against those of an independent implementation: see
// tests/engine/reference.

#include "engine/steady_state.hpp"
#include "engine/time_series.hpp"
#include "tests/catch.hpp"
#include "tests/physics/reference_table.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace {

using Catch::Matchers::WithinRel;

constexpr double rounding = 1e-9;

std::vector<double> series(const std::string& name) {
  std::vector<double> samples;
  for (const reference::Row& row : reference::table("series")) samples.push_back(row(name));
  return samples;
}

}  // namespace

TEST_CASE("an independent implementation finds the same mean, error and trend") {
  const auto rows = reference::table("statistics");
  REQUIRE(rows.size() == 10);
  for (const reference::Row& row : rows) {
    CAPTURE(row.text("series"));
    const std::vector<double> samples = series(row.text("series"));
    REQUIRE(samples.size() == 600);
    CHECK(static_cast<double>(riesel::transient_length(samples)) == row("transient"));
    const riesel::MeanEstimate mean = riesel::estimate_mean(samples);
    CHECK_THAT(mean.mean, WithinRel(row("mean"), rounding));
    CHECK_THAT(mean.error, WithinRel(row("error"), 1e-5));  // Student's point has six digits
    CHECK_THAT(mean.autocorrelation_time, WithinRel(row("time"), rounding));
    const riesel::TrendEstimate trend = riesel::estimate_trend(samples);
    CHECK_THAT(trend.slope, WithinRel(row("slope"), rounding));
    CHECK_THAT(trend.error, WithinRel(row("slope_error"), 1e-5));
  }
}

TEST_CASE("an independent implementation comes to the same verdicts") {
  std::vector<std::string> verdicts;
  for (const reference::Row& row : reference::table("statistics")) {
    CAPTURE(row.text("series"));
    const riesel::SteadyState state = riesel::assess_steady_state(series(row.text("series")));
    CHECK(riesel::name(state.verdict) == row.text("verdict"));
    CHECK(static_cast<double>(state.transient_end) == row("transient_end"));
    CHECK_THAT(state.mean, WithinRel(row("state_mean"), rounding));
    CHECK_THAT(state.error, WithinRel(row("state_error"), 1e-5));
    CHECK_THAT(state.autocorrelation_time, WithinRel(row("state_time"), rounding));
    CHECK_THAT(state.trend, WithinRel(row("trend"), rounding));
    CHECK_THAT(state.trend_error, WithinRel(row("trend_error"), 1e-5));
    verdicts.push_back(row.text("verdict"));
  }
  for (const char* verdict : {"steady", "accelerating", "drifting", "too_short"})
    CHECK(std::ranges::count(verdicts, verdict) > 0);
}
