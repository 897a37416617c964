#include "scenarios/contact_settings.hpp"

#include "engine/closed_forms.hpp"
#include "engine/exact_sum.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace riesel::scenarios {

namespace {

Attraction attraction(const io::Settings& settings) {
  return settings.text("contact.attraction") == "clip" ? Attraction::clip : Attraction::keep;
}

constexpr auto restitution_of = "contact.restitution_of";

/// 1/s, the gamma_N that gives contact.restitution to a pair of this reduced mass (kg).
double damping_from_restitution(const io::Settings& settings, double reduced_mass) {
  const double restitution = settings.number("contact.restitution");
  if (attraction(settings) == Attraction::clip && restitution <= least_restitution_without_pull)
    settings.reject("contact.restitution",
                    "would need more than critical damping, which is not offered",
                    fmt::format("choose it above {:.5f}, or contact.attraction: keep",
                                least_restitution_without_pull));
  return damping_for_restitution(restitution, settings.number("contact.stiffness"), reduced_mass,
                                 attraction(settings));
}

/// contact.restitution is that of a grain of `grains.mass` with the wall, as in the paper, unless
/// `restitution_of` says that it is that of two such grains, or of all pairs.
NormalLaw linear_law(const io::Settings& settings) {
  settings.require_exactly_one({"contact.damping", "contact.restitution"});
  const double k_n = settings.number("contact.stiffness");
  const std::string& pair = settings.text(restitution_of);
  if (settings.has("contact.damping")) {
    if (pair == "all")
      settings.reject(restitution_of, "has no meaning where contact.damping is given",
                      "remove it, or give contact.restitution instead");
    return LinearLaw{.k_n = k_n, .gamma_n = settings.number("contact.damping")};
  }
  const double mass = settings.number("grains.mass");
  if (pair == "all")
    return EqualRestitutionLaw{{.k_n = k_n, .gamma_n = damping_from_restitution(settings, 1.0)}};
  const double reduced_mass = pair == "grains" ? 0.5 * mass : mass;
  return LinearLaw{.k_n = k_n, .gamma_n = damping_from_restitution(settings, reduced_mass)};
}

NormalLaw normal_law(const io::Settings& settings) {
  const std::string& law = settings.text("contact.law");
  if (const Law* added = added_law(law)) return added->make(settings);
  if (law == "linear") return linear_law(settings);
  const double stiffness = settings.number("contact.stiffness");
  const double damping = settings.number("contact.damping");
  if (law == "hertz") return HertzKuwabaraKonoLaw{.k = stiffness, .gamma = damping};
  return PowerLaw{.k = stiffness,
                  .gamma = damping,
                  .alpha = settings.number("contact.exponent_elastic"),
                  .beta = settings.number("contact.exponent_overlap"),
                  .g = settings.number("contact.exponent_rate")};
}

SlipLaw slip_law(const io::Settings& settings) {
  const std::string& slip = settings.text("contact.slip");
  if (slip == "literal") return LiteralSlip{};
  if (slip == "viscous") return ViscousSlip{.gamma_t = settings.number("contact.slip_damping")};
  if (slip == "spring")
    return SpringSlip{.k_t = settings.number("contact.slip_stiffness"),
                      .gamma_t = settings.number("contact.slip_damping")};
  return CappedSlip{};
}

[[noreturn]] void reject_overdamped(const io::Settings& settings, const LinearContact& contact) {
  const std::string problem = attraction(settings) == Attraction::clip
                                  ? "more than critical damping, which is not offered"
                                  : "so much damping that grains do not rebound";
  if (settings.has("contact.restitution"))
    settings.reject("contact.restitution", problem,
                    settings.text(restitution_of) == "wall"
                        ? "choose it larger, or contact.restitution_of: all"
                        : "choose it larger, or contact.restitution_of: all or wall");
  settings.reject("contact.damping", problem,
                  fmt::format("choose it below {:.4g} 1/s, which is critical for the heaviest pair",
                              2.0 * std::sqrt(contact.k_n / contact.reduced_mass)));
}

}  // namespace

ContactModel contact_model(const io::Settings& settings) {
  return {.normal = normal_law(settings),
          .slip = slip_law(settings),
          .friction = settings.number("contact.friction"),
          .attraction = attraction(settings),
          .rolling_friction =
              inertia(settings) > 0.0 ? settings.number("contact.rolling_friction") : 0.0};
}

void reject_heavy_bodies(const io::Settings& settings, const std::string& mass_key, double mass,
                         const std::string& speed_key, double speed) {
  constexpr double contacts = 1000.0;  // more than are summed up
  constexpr double most = ExactSum::largest_sum / contacts;
  if (std::max(mass, 1.0) * std::max(speed * speed, 1.0) < most) return;
  settings.reject(
      mass > 1.0 ? mass_key : speed_key,
      fmt::format("{:.3g} kg at {:.3g} m/s would overflow sums over contacts", mass, speed),
      "choose less (do masses and velocities have their units?); stiffness may be "
      "scaled with the mass, which changes no motion");
}

double inertia(const io::Settings& settings) {
  const std::string& rotation = settings.text("grains.rotation");
  if (rotation == "disc") return 0.5;
  return rotation == "sphere" ? 0.4 : 0.0;
}

double collision_time(const io::Settings& settings, const ContactModel& model,
                      double reduced_mass) {
  if (const auto linear = linear_contact(model.normal, reduced_mass, model.attraction)) {
    if (!linear->rebounds()) reject_overdamped(settings, *linear);
    return linear->collision_time();
  }
  return riesel::collision_time(model.normal, reduced_mass, settings.number("contact.impact_speed"),
                                model.attraction);
}

double time_step(const io::Settings& settings, const ContactModel& model, double collision_time,
                 double reduced_mass) {
  double shortest =
      std::min(collision_time, spring_time(model.slip, inertia(settings), reduced_mass));
  // Near critical damping contacts last for ever, and nearly all happens at their beginning.
  constexpr double longest = 2.0;  // times the contact without damping; e_N is 0.0043 there
  if (linear_contact(model.normal, reduced_mass))
    shortest = std::min(
        shortest, longest * elastic_collision_time(elastic_line(model.normal), reduced_mass, 0.0));
  return shortest / settings.number("run.steps_per_collision");
}

}  // namespace riesel::scenarios
