// How a flow is stepped, and by how many threads, from the settings of `run`.
#pragma once

#include "engine/simulation.hpp"
#include "io/settings.hpp"

#include <cstddef>

namespace riesel::app {

Stepping stepping_of(const io::Settings& settings);

/// The number of threads, the user's or a useful one for so many grains; what OpenMP grants at most
/// (OMP_THREAD_LIMIT).
int threads_for(const io::Settings& settings, std::size_t grains);

/// The same for impacts and drops, which share nothing: all are useful.
int threads_for_curve(const io::Settings& settings);

}  // namespace riesel::app
