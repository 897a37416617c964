// run.h5: the record of a run. Its provenance, the time series of its observables, the final state,
// and the curve of an impact scenario. Plain HDF5 with units, for any HDF5 reader.
//
// The file is built in memory and written as a whole (write_durably()) at each flush. An HDF5 file
// that is changed in place can be lost entirely if the process is killed or the disk fills up
// during a flush, and readers have to be locked out. This way the file on the disk is always
// complete, with every row up to the last flush, and can be read while the run goes on. The price
// is memory, and a flush that takes time proportional to all rows (8 bytes per value): flush with
// each checkpoint, not with each row.
#pragma once

#include "engine/histogram_blocks.hpp"
#include "engine/present_forces.hpp"
#include "engine/state.hpp"
#include "engine/steady_state.hpp"
#include "engine/tube_profiles.hpp"
#include "engine/validity.hpp"
#include "io/provenance.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace riesel::io {

/// A column of a table: a data set with the attributes `unit` and `doc`.
struct Column {
  std::string name;  ///< of the data set: no slash
  std::string unit;  ///< "m/s", "1"
  std::string doc;   ///< one sentence
};

/// The name of the run file in the directory of a run.
inline constexpr auto run_file_name = "run.h5";

/// The kind that its seal names, see seal.hpp.
inline constexpr auto run_file_kind = "run";

/// The time over which means are taken, and whether they are those of a steady state: attributes of
/// the groups that hold them.
struct Window {
  double since;         ///< s, to the end
  SteadyVerdict state;  ///< of the flow
};

class RunFile {
public:
  /// A new file, with `provenance` in /provenance and an empty series /series/NAME for each column;
  /// it is on the disk after the first flush. Throws FileError, in particular if the file exists.
  static RunFile create(const std::filesystem::path& path, const Provenance& provenance,
                        const std::vector<Column>& series);

  /// Continues the file of a run that is resumed from a checkpoint: keeps its first `rows` rows and
  /// its provenance, and adds the new provenance as /provenance/resume_1, resume_2, ... The file on
  /// the disk is not replaced before the next flush. Throws FileError, in particular if the file
  /// has fewer rows, other columns, or belongs to another run than `provenance` does (run_key).
  static RunFile reopen(const std::filesystem::path& path, const Provenance& provenance,
                        const std::vector<Column>& series, std::int64_t rows);

  ~RunFile();
  RunFile(RunFile&&) noexcept;
  RunFile& operator=(RunFile&&) noexcept;
  RunFile(const RunFile&) = delete;
  RunFile& operator=(const RunFile&) = delete;

  /// Adds a row to the series, one value for each column in the order given at creation; throws
  /// std::invalid_argument for another number of values. In memory only until flush().
  void append(std::span<const double> row);

  /// Rows so far, flushed or not.
  std::int64_t rows() const;

  /// All rows of the column `name` so far, flushed or not.
  std::vector<double> series(std::string_view name) const;

  /// Replaces the final state in /final: grains and contacts in SI units, grains in the order of
  /// their ids, walls. `forces` are those of state.contacts, in their order. Throws
  /// std::invalid_argument for another number of them.
  void write_final_state(const State& state, std::span<const PresentForce> forces);

  /// Replaces the profiles across the tube in /profiles: `x`, the middles of the strips, and for
  /// each profile NAME and NAME_error, a value per strip.
  void write_profiles(const Strips& strips, const std::vector<TubeProfile>& profiles,
                      const Window& window);

  /// Replaces the histograms of contacts and visits in /histograms: for each a group with the lower
  /// edges of its bins, the counts since the start, and the rates over the window with their
  /// errors.
  void write_histograms(const std::vector<HistogramTable>& histograms, const Window& window);

  /// Replaces the verdict on validity in /validity: an attribute for the verdict, and one for the
  /// value of each finding.
  void write_validity(const ValidityVerdict& validity);

  /// Replaces the curve: one data set /curve/NAME for each column. Throws std::invalid_argument for
  /// a row without exactly one value per column.
  void write_curve(const std::vector<Column>& columns,
                   const std::vector<std::vector<double>>& rows);

  /// Puts all that was written so far on the disk. What was not flushed is lost with the RunFile.
  /// Call it before a checkpoint that counts these rows. Throws FileError, or Hdf5Error if memory
  /// runs out; the file on the disk is then that of the previous flush (or the new one, if only the
  /// last steps of write_durably() failed), and the next flush may succeed.
  void flush();

private:
  class Contents;
  RunFile(const std::filesystem::path& path, const std::vector<Column>& series);

  std::unique_ptr<Contents> contents_;
};

}  // namespace riesel::io
