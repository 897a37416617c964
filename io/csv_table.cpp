#include "io/csv_table.hpp"

#include "io/file_error.hpp"
#include "io/settings_text.hpp"
#include "io/units.hpp"
#include "io/utf8.hpp"
#include "io/whole_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

namespace riesel::io {
namespace {

/// The text between two commas, without the blanks around it.
struct Text {
  std::string_view text;
  int place;  // column of its first character
};

/// Stops at more cells than any table has, so that a line of nothing but commas takes little
/// memory.
std::vector<Text> split(std::string_view line) {
  constexpr std::string_view blanks = " \t\r";
  constexpr std::size_t most_cells = 1000;
  PlaceFinder places(line, "");
  std::vector<Text> cells;
  for (std::size_t begin = 0; begin <= line.size() && cells.size() < most_cells;) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::size_t first = std::min(line.find_first_not_of(blanks, begin), end);
    std::string_view text = line.substr(first, end - first);
    text = text.substr(0, text.find_last_not_of(blanks) + 1);
    cells.push_back({text, places.at(first).column});
    begin = end + 1;
  }
  return cells;
}

/// What is told if a number stands where the name of a column is due.
constexpr const char* no_headings =
    "; the first line that does not begin with # must name them (numpy.savetxt: comments='')";

bool counts(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first != std::string_view::npos && line[first] != '#';
}

/// "x (mm)"
struct Heading {
  std::string name, unit;
};

Heading heading_of(const Text& cell, const Place& place) {
  if (cell.text.find('"') != std::string_view::npos)
    throw SettingsError(place, "", "has quotation marks in the first line", "leave them out");
  const std::size_t open = cell.text.find('(');
  std::string_view name = cell.text.substr(0, open);
  name = name.substr(0, name.find_last_not_of(' ') + 1);
  if (open == std::string_view::npos) return {.name = std::string(name), .unit = ""};
  if (cell.text.back() != ')')
    throw SettingsError(place, std::string(name), "has a unit without a closing parenthesis",
                        "write it as in 'x (mm)'");
  return {.name = std::string(name),
          .unit = std::string(cell.text.substr(open + 1, cell.text.size() - open - 2))};
}

/// For errors: "x, y, mass (if any)".
std::string names_of(const std::vector<CsvColumn>& columns) {
  std::string names;
  for (const CsvColumn& column : columns)
    names += (names.empty() ? "" : ", ") + column.name + (column.required ? "" : " (if any)");
  return names;
}

/// Reads the text line by line.
class Parser {
public:
  Parser(const std::string& source, const std::vector<CsvColumn>& columns)
      : source_(&source), columns_(&columns) {}

  CsvTable parse(std::string_view text) && {
    while (!text.empty()) {
      const std::string_view line = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(line.size() + 1, text.size()));
      ++line_;
      if (!counts(line)) continue;
      const std::vector<Text> cells = split(line);
      if (headings_.empty())
        read_headings(cells);
      else
        read_row(cells);
    }
    if (cells_.lines.empty())
      throw SettingsError({*source_}, "", "has no rows",
                          "give a line with the columns " + names_of(*columns_)
                              + ", and a line for each row");
    return {*source_, std::move(index_), std::move(cells_)};
  }

private:
  struct Column {
    std::string name, unit, si_unit;
  };

  Place at(const Text& cell) const { return {*source_, line_, cell.place}; }

  void read_headings(const std::vector<Text>& cells) {
    for (const Text& cell : cells) {
      const Heading heading = heading_of(cell, at(cell));
      const auto known = std::ranges::find(*columns_, heading.name, &CsvColumn::name);
      if (known == columns_->end())
        throw SettingsError(at(cell), heading.name, "unknown column",
                            "the columns are " + names_of(*columns_)
                                + (split_quantity(cell.text) ? no_headings : ""));
      if (!index_.emplace(heading.name, headings_.size()).second)
        throw SettingsError(at(cell), heading.name, "appears twice", "remove one of the two");
      const bool also = !known->also.empty() && heading.unit == known->also;
      headings_.push_back({heading.name, also ? "" : heading.unit, known->unit});
      convert({.numeral = "1", .unit = headings_.back().unit}, headings_.back(), cell);
    }
    for (const CsvColumn& column : *columns_)
      if (column.required && !index_.contains(column.name))
        throw SettingsError(at(cells.front()), column.name, "is missing",
                            fmt::format("add the column '{} ({})'; the columns are {}", column.name,
                                        column.unit, names_of(*columns_)));
  }

  void read_row(const std::vector<Text>& cells) {
    if (cells.size() != headings_.size())
      throw SettingsError(at(cells.back()), "",
                          fmt::format("has {} {}, but the first line has {}", cells.size(),
                                      cells.size() == 1 ? "cell" : "cells", headings_.size()),
                          "give each row a cell for each column");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells_.values.push_back(value_of(cells[i], headings_[i]));
      cells_.places.push_back(cells[i].place);
    }
    cells_.lines.push_back(line_);
  }

  double value_of(const Text& cell, const Column& column) const {
    const auto numeral = split_quantity(cell.text);
    if (!numeral || !numeral->unit.empty())
      throw SettingsError(at(cell), column.name,
                          quoted(std::string(cell.text)) + " is not a number",
                          "write a decimal number; the unit belongs in the first line");
    const auto value = convert({.numeral = numeral->numeral, .unit = column.unit}, column, cell);
    if (!value)
      throw SettingsError(at(cell), column.name,
                          quoted(std::string(cell.text)) + " is outside the range of a double",
                          "write a number within it");
    return *value;
  }

  std::optional<double> convert(const QuantityText& quantity, const Column& column,
                                const Text& cell) const {
    try {
      return value_in_si(quantity, column.si_unit);
    } catch (const UnitError& error) {
      throw SettingsError(at(cell), column.name,
                          quoted(column.unit) + " is not a unit for this column", error.what());
    }
  }

  const std::string* source_;
  const std::vector<CsvColumn>* columns_;
  int line_ = 0;
  std::vector<Column> headings_;
  CsvTable::Index index_;
  CsvTable::Cells cells_;
};

}  // namespace

CsvTable parse_csv(std::string_view text, const std::string& source,
                   const std::vector<CsvColumn>& columns) {
  return Parser(source, columns).parse(without_byte_order_mark(text));
}

double CsvTable::value(std::size_t row, const std::string& column) const {
  return cells_.values.at(cell(row, column));
}

void CsvTable::reject(std::size_t row, const std::string& column, const std::string& problem,
                      const std::string& remedy) const {
  throw SettingsError({source_, line(row), cells_.places.at(cell(row, column))}, column, problem,
                      remedy);
}

CsvTable read_csv(const Settings& settings, const std::string& key,
                  const std::vector<CsvColumn>& columns) {
  constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;
  std::vector<char> bytes;
  try {
    bytes = read_whole_file(settings.text(key), most_bytes);
  } catch (const FileError& error) {
    settings.reject(key, "cannot be read (" + std::string(error.what()) + ")",
                    "give a file of comma-separated columns");
  }
  return parse_csv({bytes.data(), bytes.size()}, settings.text(key), columns);
}

}  // namespace riesel::io
