// The sizes of the free grains: uniform, truncated normal, of two sizes, or drawn from a file.
#pragma once

#include "engine/random.hpp"
#include "io/settings.hpp"

#include <cstdint>
#include <vector>

namespace riesel::scenarios {

/// Rows of the section `grains` that say how large they are; they depend on `start.kind`.
io::SettingsTable size_settings();

/// kg, of a grain of this diameter (m): in proportion to its area, from `grains.mass`.
double mass_of_diameter(const io::Settings& settings, double diameter);

class SizeDistribution {
public:
  /// Reads the file of sizes, if there is one, and rejects one that cannot be used.
  explicit SizeDistribution(const io::Settings& settings);

  /// m, of grain 0, 1, ...: depends on nothing but the settings and the seed.
  double diameter(std::uint64_t grain) const;
  /// m, no grain is larger.
  double largest() const;
  /// m^2, of the diameters: what is expected of many grains.
  double mean_square() const;
  /// The setting that says how large they are.
  const char* key() const;

private:
  double relative_diameter(std::uint64_t grain) const;

  enum class Kind { uniform, truncated_normal, bidisperse, file };
  Kind kind_;
  RandomStream stream_;
  double mean_ = 0.0;                 // m
  double spread_ = 0.0;               // relative
  double small_ = 1.0, large_ = 1.0;  // of two sizes, relative to the mean
  double large_fraction_ = 0.0;       // of the number of grains
  std::vector<double> of_file_;       // m
};

}  // namespace riesel::scenarios
