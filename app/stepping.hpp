// How a flow is stepped, and by how many threads, from the settings of `run`.
#pragma once

#include "engine/simulation.hpp"
#include "io/settings.hpp"

#include <cstddef>

namespace riesel::app {

Stepping stepping_of(const io::Settings& settings);

/// The number of threads that the user has set, or a useful one for so many grains; limited by
/// OpenMP (OMP_THREAD_LIMIT).
int threads_for(const io::Settings& settings, std::size_t grains);

/// The same for impacts and drops: as these are independent, every thread is useful.
int threads_for_curve(const io::Settings& settings);

/// Both for a machine that is not known yet, which may have any number of cores.
int most_threads_for(const io::Settings& settings, std::size_t grains);
int most_threads_for_curve(const io::Settings& settings);

}  // namespace riesel::app
