// Reads the tables of tests/physics/reference: what they hold is said there.
#pragma once

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace reference {

/// One line of a table, by the names of its columns.
class Row {
public:
  explicit Row(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}

  const std::string& text(const std::string& column) const { return cells_.at(column); }
  double operator()(const std::string& column) const { return std::stod(text(column)); }

private:
  std::map<std::string, std::string> cells_;
};

inline std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The rows of `name`.csv.
inline std::vector<Row> table(const std::string& name) {
  std::ifstream file(std::string(RIESEL_REFERENCE_TABLES) + "/" + name + ".csv");
  if (!file) throw std::runtime_error("no reference table " + name);
  std::vector<std::string> columns;
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> cells = split(line);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    if (cells.size() != columns.size()) throw std::runtime_error("a ragged row in " + name);
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < cells.size(); ++i) row[columns[i]] = cells[i];
    rows.emplace_back(std::move(row));
  }
  return rows;
}

}  // namespace reference
