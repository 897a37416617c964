#include "app/plain_words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace riesel::app {

std::string explanation(const std::string& state) {
  if (state == "steady") return "no trend after the transient";
  if (state == "accelerating") return "the grains still gain speed: the mean is no steady velocity";
  if (state == "drifting") return "there still is a trend: the mean is no steady velocity";
  return "too few independent samples for a steady mean";
}

std::string explanation(const Finding& f) {
  if (std::isnan(f.value)) return fmt::format("{}: {}; {}", f.name, f.meaning, f.remedy);
  const double threshold = f.verdict == Validity::unphysical ? f.unphysical : f.suspect;
  return fmt::format("{} = {:.3g}, {} {:.3g}: {}; {}", f.name, f.value,
                     f.low_is_bad ? "below" : "above", threshold, f.meaning, f.remedy);
}

}  // namespace riesel::app
