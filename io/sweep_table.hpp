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

  /// A column of its own, or one more value of the column with this name.
  void set(std::size_t row, const std::string& column, Cell value, const std::string& unit = "");

  struct Column {
    std::string name;
    std::string unit;  ///< empty if not known or none
    std::vector<Cell> cells;
  };
  const std::vector<Column>& columns() const { return columns_; }
  std::size_t rows() const { return rows_; }

private:
  std::size_t rows_;
  std::vector<Column> columns_;
};

/// All single values of the summary.json of a run, nested names joined by dots
/// ("mean_axial_velocity.error"); of lists only `findings`, by their names, and `lines`, by their
/// v_x. Throws FileError.
std::vector<std::pair<std::string, Cell>> flat_summary(const std::filesystem::path& path);

inline constexpr auto sweep_csv_name = "sweep.csv";
inline constexpr auto sweep_h5_name = "sweep.h5";

/// A line of names, then a line per row; quoted as RFC 4180 says, nothing for a missing value.
/// Numbers have the digits that give the same double.
std::string to_csv(const SweepTable& table);

/// One data set /points/NAME per column: doubles with NaN for a missing value, or strings, empty
/// for one; and the sweep file verbatim. Throws FileError; in particular for a column with a name
/// that no data set can have ("a/b"), which only a summary.json of somebody else has.
void write_hdf5(const std::filesystem::path& path, const SweepTable& table,
                std::string_view sweep_file);

}  // namespace riesel::io
