// When a run that asks for precision may stop.
//
// Checking an error bar again and again until it is small enough would prefer moments at which it
// is small by chance. So a run is checked rarely, each time it has become a quarter longer, and has
// to be precise twice in a row. The remaining bias is measured in docs/statistics-methods.md.
//
// The rule depends on the series only: an interrupted run stops where an uninterrupted one does.
#pragma once

#include "engine/steady_state.hpp"

#include <cstddef>

namespace riesel {

/// The least number of samples with which a run that asks for precision can end: those of the
/// second check.
inline constexpr std::size_t fewest_samples_to_stop = 125;

/// Whether a series with this number of samples is checked: first when there are 100.
bool is_time_to_look(std::size_t samples);

/// Whether a flow is to be checked now, and is found steady (assess_flow), with an error bar of at
/// most `relative_error` of the mean, both now and at the check before. Throws
/// std::invalid_argument for a sample that is not finite.
bool is_precise(const FlowSeries& flow, double relative_error);

}  // namespace riesel
