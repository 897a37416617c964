// From the settings of the section `contact` to the laws of the engine, and to the time step.
#pragma once

#include "engine/contact_law.hpp"
#include "io/settings.hpp"

namespace riesel::scenarios {

/// s, shortest duration of a head-on contact with the given reduced mass (kg). Rejects a contact
/// that would not rebound.
double collision_time(const io::Settings& settings, const ContactModel& model, double reduced_mass);

/// s, collision time divided by run.steps_per_collision; or half a period of the tangential spring
/// of the same two bodies, where that is shorter.
double time_step(const io::Settings& settings, const ContactModel& model, double collision_time,
                 double reduced_mass);

/// Rejects bodies whose momenta or energies (of so many kg and m/s) are beyond what sums over their
/// contacts hold.
void reject_heavy_bodies(const io::Settings& settings, const std::string& mass_key, double mass,
                         const std::string& speed_key, double speed);

/// Moment of inertia of the grains over m r^2; 0: they do not rotate.
double inertia(const io::Settings& settings);

}  // namespace riesel::scenarios
