// The profiles and histograms that a report asks run.h5 for, for tests that write one.
#pragma once

#include "engine/histogram_blocks.hpp"
#include "engine/tube_profiles.hpp"

#include <vector>

namespace riesel {

/// All of them, each like this one but for its name.
inline std::vector<TubeProfile> profiles_like(TubeProfile one) {
  std::vector<TubeProfile> all;
  for (const char* name : {"area_fraction", "mean_axial_velocity", "temperature_x", "temperature_y",
                           "stress_xx", "stress_xy", "stress_yy"}) {
    one.name = name;
    all.push_back(one);
  }
  return all;
}

inline std::vector<HistogramTable> histograms_like(HistogramTable one) {
  std::vector<HistogramTable> all;
  for (const char* name : {"grain_contact_duration", "wall_contact_duration",
                           "grain_contact_overlap", "wall_contact_overlap"}) {
    one.name = name;
    all.push_back(one);
  }
  return all;
}

}  // namespace riesel
