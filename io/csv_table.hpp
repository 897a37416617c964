// Tables of quantities that a settings file refers to: text, a line per row, commas between cells.
//
// The first line names the columns, each with its unit: "x (mm), vx (m/s)"; without one, numbers
// are SI. Lines that are empty or begin with # do not count. What is wrong is told with file, line
// and column, as in a settings file.
#pragma once

#include "io/settings.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace riesel::io {

/// A column that a table may have.
struct CsvColumn {
  std::string name;
  std::string unit;  ///< SI unit of its values
  bool required = true;
  std::string also = {};  ///< what its heading may say instead of a unit that converts to it
};

class CsvTable {
public:
  /// The place of each column in a row, by its name.
  using Index = std::map<std::string, std::size_t>;

  /// Row by row.
  struct Cells {
    std::vector<double> values;  ///< in SI units, finite
    std::vector<int> places;     ///< column of the first character, from 1, in characters
    std::vector<int> lines;      ///< of each row, from 1
  };

  CsvTable(std::string source, Index index, Cells cells)
      : source_(std::move(source)), index_(std::move(index)), cells_(std::move(cells)) {}

  std::size_t rows() const { return cells_.lines.size(); }
  bool has(const std::string& column) const { return index_.contains(column); }
  /// In SI units; of a column that it has.
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

/// `source` stands for the file in errors. Throws SettingsError for a text without rows, columns
/// that are missing, unknown or there twice, and cells that are no numbers.
CsvTable parse_csv(const std::string& text, const std::string& source,
                   const std::vector<CsvColumn>& columns);

/// The file that the setting `key`, a path, names. One that cannot be read, or is longer than 64
/// MB, is rejected at the key.
CsvTable read_csv(const Settings& settings, const std::string& key,
                  const std::vector<CsvColumn>& columns);

}  // namespace riesel::io
