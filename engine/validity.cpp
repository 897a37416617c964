#include "engine/validity.hpp"

#include "engine/estimate.hpp"
#include "engine/named.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace riesel {

namespace {

constexpr std::array<Word<Validity>, 3> verdicts = {{{Validity::valid, "valid"},
                                                     {Validity::suspect, "suspect"},
                                                     {Validity::unphysical, "unphysical"}}};

constexpr double none = std::numeric_limits<double>::infinity();

struct Criterion {
  std::string_view name;
  double Evidence::*value;
  double suspect, unphysical;
  bool low_is_bad;
  std::string_view meaning, remedy;
};

constexpr std::string_view stiffer = "raise contact.stiffness";
constexpr std::string_view finer = "raise run.steps_per_collision";

constexpr Criterion overlap_criterion = {"max_overlap_ratio",
                                         &Evidence::max_overlap_ratio,
                                         suspect_overlap_ratio,
                                         unphysical_overlap_ratio,
                                         false,
                                         "grains sink deep into each other",
                                         stiffer};
constexpr Criterion brake_criterion = {
    "brake_failure_fraction",
    &Evidence::brake_failure_fraction,
    0.1,
    unphysical_brake_failure,
    false,
    "walls brake by contacts that are passed through before they can push",
    stiffer};

/// For drops of columns only: Evidence has no member for it.
constexpr Criterion detachment_criterion = {
    "detachment", nullptr, 0.1,
    0.5,          false,   "contacts last so long that beads touch several others at once",
    stiffer};

constexpr Criterion energy_criterion = {
    "energy_error_ratio",
    &Evidence::energy_error_ratio,
    0.01,
    unphysical_energy_error,
    false,
    "energy comes or goes by errors of the time step, which is too long for the forces",
    finer};

constexpr std::array<Criterion, 9> criteria = {{
    overlap_criterion,
    brake_criterion,
    {"passages_per_wall_visit", &Evidence::passages_per_visit, 0.5, 2.0, false,
     "grains scrape through the wall grains one after the other", stiffer},
    {"wall_speed_over_v_crit", &Evidence::wall_speed_ratio, 0.5, 3.0, false,
     "grains pass the wall grains so fast that contacts push them less than rigid ones would",
     stiffer},
    {"pulling_fraction", &Evidence::pulling_fraction, 0.15, none, false,
     "the damping makes contacts pull", "compare with contact.attraction: clip"},
    {"steps_per_contact", &Evidence::steps_per_contact, 10.0, -none, true,
     "the time step does not resolve the shortest contacts", finer},
    energy_criterion,
    {"limits_exceeded", &Evidence::limits_exceeded, 0.0, none, false,
     "limits of the settings were exceeded", "see validity.warnings in summary.json"},
    {"grain_contact_rate_times_t_col", &Evidence::contact_rate_times_t_col, 0.5, none, false,
     "grains meet others again before they have separated, and lose less than hard ones", stiffer},
}};

/// Whether the criterion counts. In dense flows grains jostle at a wall without end, and contacts
/// cut short that brake next to nothing do not show that they pass through wall grains.
bool matters(const Criterion& c, const Evidence& evidence) {
  constexpr double next_to_nothing = 0.01;
  return c.value != &Evidence::passages_per_visit
         || !(evidence.brake_failure_fraction < next_to_nothing);
}

Validity judge(const Criterion& c, double value) {
  if (std::isnan(value)) return Validity::suspect;
  const auto beyond = [&](double threshold) {
    return c.low_is_bad ? value < threshold : value > threshold;
  };
  if (beyond(c.unphysical)) return Validity::unphysical;
  return beyond(c.suspect) ? Validity::suspect : Validity::valid;
}

/// The remedy for a value that is not known. Braking means impulse along -y: there is none if the
/// flow goes along -y.
std::string_view remedy_of_ignorance(const Criterion& c) {
  return c.value == &Evidence::brake_failure_fraction
             ? "run longer, and without gravity let the flow go along +y"
             : "run longer";
}

Finding finding_of(const Criterion& c, double value, Validity verdict) {
  return {.name = c.name,
          .value = value,
          .suspect = c.suspect,
          .unphysical = c.unphysical,
          .low_is_bad = c.low_is_bad,
          .verdict = verdict,
          .meaning = std::isnan(value) ? "not known" : c.meaning,
          .remedy = std::isnan(value) ? remedy_of_ignorance(c) : c.remedy};
}

}  // namespace

const Finding* ValidityVerdict::find(std::string_view name) const {
  const auto found = std::ranges::find(findings, name, &Finding::name);
  return found == findings.end() ? nullptr : &*found;
}

double ValidityVerdict::value_of(std::string_view name) const {
  const Finding* found = find(name);
  return found == nullptr ? unknown : found->value;
}

ValidityVerdict judge(const Evidence& evidence) {
  ValidityVerdict result{.verdict = Validity::valid, .findings = {}};
  for (const Criterion& c : criteria) {
    const double value = evidence.*c.value;
    const Validity verdict = matters(c, evidence) ? judge(c, value) : Validity::valid;
    result.findings.push_back(finding_of(c, value, verdict));
    result.verdict = std::max(result.verdict, verdict);
  }
  return result;
}

std::optional<Finding> finding_named(std::string_view name, double value) {
  for (const Criterion& c : criteria)
    if (c.name == name) return finding_of(c, value, judge(c, value));
  return std::nullopt;
}

Finding judge_impacts(double max_overlap_ratio, double brake_failure_fraction,
                      double energy_error_ratio) {
  const auto finding = [](const Criterion& c, double value) {
    return finding_of(c, value, judge(c, value));
  };
  // Of equally bad ones the first: a time step that is too long makes the other values meaningless.
  return std::max({finding(energy_criterion, energy_error_ratio),
                   finding(brake_criterion, brake_failure_fraction),
                   finding(overlap_criterion, max_overlap_ratio)},
                  [](const Finding& a, const Finding& b) { return a.verdict < b.verdict; });
}

Validity judge_drop(double max_overlap_ratio, double detachment, double energy_error_ratio) {
  return std::max({judge(overlap_criterion, max_overlap_ratio),
                   judge(detachment_criterion, std::abs(detachment)),
                   judge(energy_criterion, energy_error_ratio)});
}

double detachment(double restitution, double rigid_restitution) {
  constexpr double hardly_any = 0.01;  // of the energy: comparable with errors of the time step
  const double rigid_energy = rigid_restitution * rigid_restitution;
  if (rigid_energy > 1.0 - hardly_any) return 0.0;
  return (restitution * restitution - rigid_energy) / (1.0 - rigid_energy);
}

std::optional<Validity> validity_named(std::string_view text) { return value_in(verdicts, text); }

std::string_view name(Validity validity) { return name_in(verdicts, validity); }

}  // namespace riesel
