// How a flow is stepped, from the settings of `run`.
#pragma once

#include "engine/simulation.hpp"
#include "io/settings.hpp"

#include <cstddef>

namespace riesel::app {

Stepping stepping_of(const io::Settings& settings);

/// The number of threads, the user's or a useful one for so many grains.
int threads_for(const io::Settings& settings, std::size_t grains);

}  // namespace riesel::app
