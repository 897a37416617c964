// The results of a sweep as one table, a row per point: sweep.csv for whatever reads text, sweep.h5
// for the rest.
#pragma once

#include "io/sweep_manifest.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace riesel::io {

/// Columns of equal length, in the order in which they were added.
class SweepTable {
public:
  explicit SweepTable(std::size_t rows) : rows_(rows) {}

  /// Sets a value of the column with this name, which is added if there is none.
  void set(std::size_t row, const std::string& column, Cell value, const std::string& unit = "");

  struct Column {
    std::string name;
    std::string unit;  ///< empty if unknown or none
    std::vector<Cell> cells;
  };
  const std::vector<Column>& columns() const { return columns_; }
  std::size_t rows() const { return rows_; }

private:
  std::size_t rows_;
  std::vector<Column> columns_;
};

/// All single values of a run's summary.json, nested names joined by dots
/// ("mean_axial_velocity.error"). Of lists it takes only `findings`, by their names, and `lines`,
/// by their v_x. Throws FileError.
std::vector<std::pair<std::string, Cell>> flat_summary(const std::filesystem::path& path);

inline constexpr auto sweep_csv_name = "sweep.csv";
inline constexpr auto sweep_h5_name = "sweep.h5";

/// A line of names, then a line per row; quoted as in RFC 4180, empty for a missing value. Numbers
/// have enough digits to read back to the same double.
std::string to_csv(const SweepTable& table);

/// One data set /points/NAME per column, of doubles (NaN for a missing value) or of strings (empty
/// for one), and the sweep file verbatim. Throws FileError; in particular for a column whose name
/// no data set can have ("a/b"), which only a summary.json of another program has.
void write_hdf5(const std::filesystem::path& path, const SweepTable& table,
                std::string_view sweep_file);

}  // namespace riesel::io
