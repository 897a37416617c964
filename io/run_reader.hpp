// run.h5 read back: what the report of a finished run needs of it.
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

/// /final: the parts of a State that a report shows.
struct FinalState {
  Box box{};
  double time = 0.0;  ///< s
  std::int64_t step = 0;
  std::vector<Grain> grains;  ///< a grain's id is its index
  std::vector<WallLattice> walls;
  std::vector<ContactName> contacts;  ///< they refer to these grains and walls
  /// N, absolute values of the forces of the contacts, not checked; empty in files of riesel before
  /// 0.16.
  std::vector<double> forces;

  double mean_diameter() const;  ///< m
};

struct Series {
  Column column;
  std::vector<double> values;
};

/// A quantity across the tube, a value per strip; NaN where it is unknown.
struct ProfileWithErrors {
  Column column;
  std::vector<double> values, errors;
};

/// /profiles
struct Profiles {
  std::vector<double> x;  ///< m, middles of the strips
  std::vector<ProfileWithErrors> quantities;

  /// Whether grains rotate, and the profiles of their spins are there.
  bool have_spins() const;
  /// Throws std::out_of_range for a name that is not there.
  const ProfileWithErrors& named(const std::string& name) const;
};

/// One of /histograms: how many contacts or visits ended per second after the transient, by bin.
struct HistogramWithErrors {
  Column column;                      ///< of the quantity on the axis
  std::vector<double> lower_edges;    ///< of the bins, positive and ascending
  std::vector<double> rates, errors;  ///< 1/s; NaN where they are unknown
};

/// How a run was made, see Provenance.
struct RunHistory {
  Provenance start;
  std::vector<Provenance> resumes;  ///< one for each time that the run was resumed
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

/// Throws FileError if the file cannot be read, is damaged, or is not that of a flow.
RunContents read_run_file(const std::filesystem::path& path);

/// Of any kind of run. Throws FileError if the file cannot be read or is damaged.
RunHistory read_run_history(const std::filesystem::path& path);

}  // namespace riesel::io
