// The time step, and whatever else follows from the settings of contacts and of the bodies in them.
#pragma once

#include "engine/contact_law.hpp"
#include "io/settings.hpp"

namespace riesel::scenarios {

/// The duration of a head-on contact with the given reduced mass (kg), in s; of laws for which it
/// depends on the speed, at contact.impact_speed. Throws io::SettingsError if under a linear law
/// the bodies would not rebound.
double collision_time(const io::Settings& settings, const ContactModel& model, double reduced_mass);

/// The time step, in s: the collision time (s) or, if shorter, half a period of the tangential
/// spring of two bodies with this reduced mass (kg), or twice their contact without damping under a
/// linear law, divided by run.steps_per_collision.
double time_step(const io::Settings& settings, const ContactModel& model, double collision_time,
                 double reduced_mass);

/// Rejects bodies of this mass (kg) and speed (m/s) if sums of momenta or energies over their
/// contacts might overflow. The keys are of the settings that the error is to blame.
void reject_heavy_bodies(const io::Settings& settings, const std::string& mass_key, double mass,
                         const std::string& speed_key, double speed);

/// The moment of inertia of the grains over m r^2; 0: they do not rotate.
double inertia(const io::Settings& settings);

}  // namespace riesel::scenarios
