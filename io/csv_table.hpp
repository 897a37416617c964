// Tables of quantities that a settings file refers to: text files with a line per row and commas
// between cells.
//
// The first line names the columns, each with its unit: "x (mm), vx (m/s)"; numbers in a column
// without a unit are in SI. Empty lines and lines that begin with # are skipped. Errors name file,
// line and column, as for a settings file.
#pragma once

#include "io/settings.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace riesel::io {

/// A column that a table may have.
struct CsvColumn {
  std::string name;
  std::string unit;  ///< SI unit of its values
  bool required = true;
  std::string also = {};  ///< text that may replace the unit in its heading; numbers are then in SI
};

class CsvTable {
public:
  /// The position of each column in a row, by its name.
  using Index = std::map<std::string, std::size_t>;

  /// The cells, row by row.
  struct Cells {
    std::vector<double> values;  ///< in SI units, finite
    std::vector<int> places;     ///< where each cell begins in its line, in characters, from 1
    std::vector<int> lines;      ///< of each row, from 1
  };

  CsvTable(std::string source, Index index, Cells cells)
      : source_(std::move(source)), index_(std::move(index)), cells_(std::move(cells)) {}

  std::size_t rows() const { return cells_.lines.size(); }
  bool has(const std::string& column) const { return index_.contains(column); }
  /// In SI units. Throws std::out_of_range for a column that the table does not have.
  double value(std::size_t row, const std::string& column) const;

  /// Throws the SettingsError "column: problem; remedy" at the cell.
  [[noreturn]] void reject(std::size_t row, const std::string& column, const std::string& problem,
                           const std::string& remedy) const;
  int line(std::size_t row) const { return cells_.lines.at(row); }

private:
  std::size_t cell(std::size_t row, const std::string& column) const {
    return row * index_.size() + index_.at(column);
  }

  std::string source_;
  Index index_;
  Cells cells_;
};

/// `source` names the file in errors. Throws SettingsError for a text without rows, for missing,
/// unknown or repeated columns, and for cells that are not numbers.
CsvTable parse_csv(std::string_view text, const std::string& source,
                   const std::vector<CsvColumn>& columns);

/// Reads the file that the setting `key`, a path, names. Throws SettingsError; in particular, at
/// the key, for a file that cannot be read or is longer than 1 GiB.
CsvTable read_csv(const Settings& settings, const std::string& key,
                  const std::vector<CsvColumn>& columns);

}  // namespace riesel::io
