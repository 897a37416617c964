// From the settings of the section `contact` to the laws of the engine, and to the time step.
#pragma once

#include "engine/contact_law.hpp"
#include "io/settings.hpp"

namespace riesel::scenarios {

/// s, shortest duration of a head-on contact with the given reduced mass (kg). Rejects a contact
/// that would not rebound.
double collision_time(const io::Settings& settings, const ContactModel& model, double reduced_mass);

/// s, collision time divided by run.steps_per_collision.
double time_step(const io::Settings& settings, double collision_time);

}  // namespace riesel::scenarios
