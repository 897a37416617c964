#include "app/plain_words.hpp"

#include "engine/time_series.hpp"
#include "io/shell_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace riesel::app {

std::string call_of(std::string_view subcommand, const std::filesystem::path& path) {
  return fmt::format("{} {}", call_of(subcommand), io::path_argument(path));
}

std::string call_of(std::string_view subcommand) {
  return fmt::format("{} {}", io::in_quotes(program_invocation_short_name), subcommand);
}

namespace {

/// " of the granular temperature", say: the series that decided; empty for the usual one.
std::string_view deciding_series(const io::FlowSummary& s) {
  switch (s.held_back_by.value_or(s.judged_by)) {
  case io::JudgedBy::granular_temperature:
    return " of the granular temperature";
  case io::JudgedBy::rotational_temperature:
    return " of the rotational temperature";
  case io::JudgedBy::mean_vy:
    break;
  }
  return s.held_back_by ? " of the mean velocity" : "";
}

}  // namespace

std::string explanation_of_state(const io::FlowSummary& s) {
  const std::string_view of_what = deciding_series(s);
  if (s.state == SteadyVerdict::steady)
    return fmt::format("no trend{} after the transient", of_what);
  if (s.state == SteadyVerdict::accelerating)
    return s.judged_by == io::JudgedBy::granular_temperature
               ? "the granular temperature still grows: its mean is not a steady one"
               : "the grains still gain speed: the mean is not a steady velocity";
  if (s.state == SteadyVerdict::drifting)
    return fmt::format("there is still a trend{}: the mean is not a steady one", of_what);
  if (s.independent_samples < min_independent_samples)
    return fmt::format("only {:.2g} of the {:.0f} independent samples{} needed for a steady mean",
                       s.independent_samples, min_independent_samples, of_what);
  if (s.held_back_by)
    return fmt::format("the transient{} takes most of the time: too much for a steady mean",
                       of_what);
  return fmt::format("the transient takes {:.3g} of {:.3g} s, too much for a steady mean",
                     s.transient_end, s.time);
}

bool asks_for_more(const io::FlowSummary& s) {
  return s.state == SteadyVerdict::too_short || s.state == SteadyVerdict::drifting
         || (s.state == SteadyVerdict::steady && s.ended_by == io::EndedBy::at_most);
}

double sufficient_duration(const io::FlowSummary& s) {
  if (s.state != SteadyVerdict::too_short) return 2.0 * s.time;
  const double after_transient = s.time - s.transient_end;
  const double wanted = 1.5 * min_independent_samples / std::max(s.independent_samples, 1.0);
  const double seconds = 3.0 * s.transient_end + std::max(wanted - 1.0, 0.0) * after_transient;
  return std::max(seconds, 1.5 * s.time);
}

std::string_view explanation_of_end(io::EndedBy ended_by) {
  switch (ended_by) {
  case io::EndedBy::duration:
    return "its duration was over";
  case io::EndedBy::precision:
    return "the mean is known as well as was asked for";
  case io::EndedBy::at_most:
    return "the time was up before the mean reached the requested precision in two successive "
           "checks";
  }
  return "";
}

namespace {

/// The power of ten of the first digit after rounding to `digits` digits: -1 for 0.0996 and two
/// digits, as that is 0.10.
int order_of(double x, int digits) {
  const std::string text = fmt::format("{:.{}e}", x, digits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

/// "1.534" and "0.050": the error with `error_digits` digits, and the value rounded to the same
/// place. If the error is not known or 0, the value has `digits` digits and `error` is empty.
struct Digits {
  std::string value, error;
};

Digits digits_of(const io::Measured& m, int digits, int error_digits) {
  if (!(m.error > 0.0) || !std::isfinite(m.error))
    return {fmt::format("{:.{}g}", m.value, digits), ""};
  constexpr int most_decimals = 6;  // beyond, numbers are written with an exponent
  const int last = order_of(m.error, error_digits) - error_digits + 1;
  const int decimals = std::max(0, -last);
  if (decimals <= most_decimals)
    return {fmt::format("{:.{}f}", m.value, decimals), fmt::format("{:.{}f}", m.error, decimals)};
  constexpr int exact = std::numeric_limits<double>::max_digits10;
  const int significant = m.value == 0.0 ? 1 : order_of(m.value, exact) - last + 1;
  return {fmt::format("{:.{}g}", m.value, std::max(1, significant)),
          fmt::format("{:.{}g}", m.error, error_digits)};
}

}  // namespace

std::string with_error(const io::Measured& m, std::string_view unit, std::string_view sign,
                       int digits, int error_digits) {
  if (std::isnan(m.value)) return "not known";
  const auto [value, error] = digits_of(m, digits, error_digits);
  const std::string bar = std::isnan(m.error) ? " (error not known)"
                          : error.empty()     ? ""
                                              : fmt::format(" {} {}", sign, error);
  return fmt::format("{}{}{}{}", value, bar, unit.empty() ? "" : " ", unit);
}

std::string explanation(const Finding& f) {
  if (std::isnan(f.value)) return fmt::format("{}: {}; {}", f.name, f.meaning, f.remedy);
  const double threshold = f.verdict == Validity::unphysical ? f.unphysical : f.suspect;
  return fmt::format("{} = {:.3g}, {} {:.3g}: {}; {}", f.name, f.value,
                     f.low_is_bad ? "below" : "above", threshold, f.meaning, f.remedy);
}

std::string so_many(std::int64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

void add_count(std::string& text, std::int64_t count, std::string_view name) {
  if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
}

std::string counted(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) add_count(text, count, name);
  return text;
}

namespace {

template <class Point>
std::string verdicts_of(const std::vector<Point>& points) {
  std::string text;
  for (const Validity validity : {Validity::valid, Validity::suspect, Validity::unphysical})
    add_count(text, std::ranges::count(points, validity, &Point::verdict), name(validity));
  return text;
}

}  // namespace

std::string count_of_verdicts(const io::CurveSummary& summary) {
  return verdicts_of(summary.curve);
}

std::string count_of_verdicts(const io::ColumnSummary& summary) {
  return verdicts_of(summary.column);
}

LeftOut left_out_of(const io::CurveSummary& summary) {
  LeftOut all;
  for (const io::CurvePoint& point : summary.curve) {
    all.passed += point.passed;
    all.stuck += point.stuck;
  }
  return all;
}

namespace {

/// Explains the finding `cause`, which is beyond its threshold or, where nothing brakes, not
/// `known`. `cause` is empty in summaries of versions that did not record it.
std::string explanation_of_points(Validity verdict, const std::string& cause, bool known) {
  const auto finding = finding_named(cause, HUGE_VAL);
  if (!finding) return "for a reason that this summary does not tell";
  if (!known) return cause + " is not known: no impact comes away from the wall, or nothing brakes";
  return fmt::format("{} above {:.3g}: {}; {}", cause,
                     verdict == Validity::unphysical ? finding->unphysical : finding->suspect,
                     finding->meaning, finding->remedy);
}

}  // namespace

std::vector<CurveReason> reasons_of(const io::CurveSummary& summary) {
  struct Count {
    int points = 0;
    double first = HUGE_VAL;  // m/s
  };
  using CountOf = std::map<double, Count>;  // by v_x
  std::map<double, int> points_at;
  std::map<std::tuple<Validity, std::string, bool>, CountOf> found;
  for (const io::CurvePoint& point : summary.curve) {
    ++points_at[point.v_x];
    if (point.verdict == Validity::valid) continue;
    const bool known =
        point.cause != "brake_failure_fraction" || !std::isnan(point.brake_failure_fraction);
    Count& count = found[{point.verdict, point.cause, known}][point.v_x];
    ++count.points;
    count.first = std::min(count.first, point.v_y);
  }
  std::vector<CurveReason> reasons;
  for (const auto& [what, count_of] : found) {
    const auto& [verdict, cause, known] = what;
    reasons.push_back({verdict, explanation_of_points(verdict, cause, known), {}});
    for (const auto& [v_x, count] : count_of)
      reasons.back().places.push_back(
          fmt::format("at v_x = {:.4g} m/s {} of {} points, the first at v_y = {:.4g} m/s", v_x,
                      count.points, points_at[v_x], count.first));
  }
  return reasons;
}

std::string description_of(const RigidColumn& rigid) {
  if (rigid.collapsed) return "collide infinitely often and keep nothing";
  return fmt::format("effective restitution {:.4g}, rebound {:.4g}, {} collisions",
                     rigid.restitution, rigid.rebound, rigid.collisions);
}

std::string where_hard(const io::ColumnSummary& summary) {
  const auto touches_several = [](const io::ColumnPoint& p) {
    return judge_drop(0.0, p.detachment, 0.0) != Validity::valid;
  };
  std::vector<io::ColumnPoint> points = summary.column;
  // Drops that were given up say nothing about how many beads touch at once.
  std::erase_if(points, [](const io::ColumnPoint& p) { return std::isnan(p.detachment); });
  std::ranges::sort(points, std::ranges::greater{}, &io::ColumnPoint::gap_ratio);
  const auto soft = std::ranges::find_if(points, touches_several);
  if (soft == points.end()
      && std::ranges::count(summary.column, Validity::valid, &io::ColumnPoint::verdict)
             < std::ssize(summary.column))
    return "not resolved, or too deep: raise run.steps_per_collision or contact.stiffness.";
  if (soft == points.begin())
    return "t_col is too long for all of these gaps: raise contact.stiffness.";
  const double from = std::prev(soft)->gap_ratio;
  if (soft == points.end()) return "t_col is short enough for all of these gaps.";
  return fmt::format(
      "t_col is too long for gaps below {:.3g} v t_col. Raise contact.stiffness until the gaps are "
      "wider than that: t_col decreases as 1/sqrt(stiffness).",
      from);
}

}  // namespace riesel::app
