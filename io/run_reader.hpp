// run.h5 read back: what a report of a run that is over needs of it.
#pragma once

#include "engine/box.hpp"
#include "engine/contact.hpp"
#include "engine/state.hpp"
#include "engine/wall_lattice.hpp"
#include "io/provenance.hpp"
#include "io/run_file.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace riesel::io {

/// /final: what there is to see of a State.
struct FinalState {
  Box box{};
  double time = 0.0;  ///< s
  std::int64_t step = 0;
  std::vector<Grain> grains;  ///< a grain's id is its place
  std::vector<WallLattice> walls;
  std::vector<Contact> contacts;  ///< their names fit the grains and the walls

  double mean_diameter() const;  ///< m
};

struct Series {
  Column column;
  std::vector<double> values;
};

/// A quantity across the tube, by strip; not a number where it is not known.
struct ProfileWithErrors {
  Column column;
  std::vector<double> values, errors;
};

/// /profiles
struct Profiles {
  std::vector<double> x;  ///< m, middles of the strips
  std::vector<ProfileWithErrors> quantities;

  /// Throws std::out_of_range for a name that is not there.
  const ProfileWithErrors& named(const std::string& name) const;
};

/// One of /histograms: how often contacts or visits ended after the transient, by bin.
struct HistogramWithErrors {
  Column column;                      ///< of what stands on the axis
  std::vector<double> lower_edges;    ///< of the bins, positive and ascending
  std::vector<double> rates, errors;  ///< 1/s; not a number where they are not known
};

/// What tells by whom and how a run was made.
struct RunHistory {
  Provenance start;
  std::vector<Provenance> resumes;  ///< the same of each time it was resumed
};

struct RunContents {
  FinalState final_state;
  std::vector<Series> series;  ///< all of the same length
  Profiles profiles;           ///< all of the same length
  std::vector<HistogramWithErrors> histograms;
  RunHistory history;

  /// Throws std::out_of_range for a name that is not there.
  const Series& series_of(const std::string& name) const;
  const HistogramWithErrors& histogram_of(const std::string& name) const;
};

/// Throws FileError if the file cannot be read, is damaged, or is of something else than a flow.
RunContents read_run_file(const std::filesystem::path& path);

/// Of any run. Throws FileError as above.
RunHistory read_run_history(const std::filesystem::path& path);

}  // namespace riesel::io
