// The sizes of the free grains: uniform, truncated normal, of two sizes, or drawn from a file.
#pragma once

#include "engine/random.hpp"
#include "io/settings.hpp"

#include <cstdint>
#include <vector>

namespace riesel::scenarios {

/// Rows of the section `grains` that say how large they are; they depend on `start.kind`.
io::SettingsTable size_settings();

/// The mass (kg) of a grain of this diameter (m): `grains.mass` in proportion to its area.
double mass_of_diameter(const io::Settings& settings, double diameter);

class SizeDistribution {
public:
  /// Reads the file of sizes, if the settings name one. Throws io::SettingsError if it cannot be
  /// used.
  explicit SizeDistribution(const io::Settings& settings);

  /// The diameter (m) of grain 0, 1, ...: depends on nothing but the settings and the seed.
  double diameter(std::uint64_t grain) const;
  /// An upper bound on all diameters, in m.
  double largest() const;
  /// The expectation of the diameter, in m.
  double mean() const { return mean_; }
  /// The expectation of the squared diameter, in m^2.
  double mean_square() const;
  /// The key of the setting to blame for sizes that do not fit.
  const char* key() const;

private:
  double relative_diameter(std::uint64_t grain) const;

  enum class Kind { uniform, truncated_normal, bidisperse, file };
  Kind kind_;
  RandomStream stream_;
  double mean_ = 0.0;                 // m, of all kinds
  double spread_ = 0.0;               // relative
  double small_ = 1.0, large_ = 1.0;  // of two sizes, relative to the mean
  double large_fraction_ = 0.0;       // of the number of grains
  std::vector<double> of_file_;       // m
};

}  // namespace riesel::scenarios
