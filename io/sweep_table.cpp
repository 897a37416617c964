#include "io/sweep_table.hpp"

#include "engine/estimate.hpp"
#include "io/build_info.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/hdf5_file.hpp"
#include "io/json_cell.hpp"
#include "io/json_file.hpp"
#include "io/summary_reader.hpp"
#include "io/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace riesel::io {
namespace {

void flatten(const Json& json, const std::string& prefix,
             std::vector<std::pair<std::string, Cell>>& values) {
  for (const auto& [name, value] : json.items()) {
    if (value.is_object()) {
      flatten(value, prefix + name + ".", values);
    } else if (!value.is_array()) {
      // So that the column holds texts in any sweep: cells that are all null would make it numbers.
      const bool is_no_text = value.is_null() && name == "held_back_by";
      values.emplace_back(prefix + name, is_no_text ? Cell(std::string()) : cell_of(value));
    } else if (name == "findings") {
      for (const auto& finding : value)
        values.emplace_back(prefix + name + "." + finding.at("name").get<std::string>(),
                            cell_of(finding.at("value")));
    } else if (name == "lines") {
      for (const auto& line : value)
        flatten(line, fmt::format("{}{}.{}.", prefix, name, line.at("v_x").get<double>()), values);
    }
  }
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_text(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  if (const auto* text = std::get_if<std::string>(&cell)) return csv_text(*text);
  return "";
}

bool has_text(const SweepTable::Column& column) {
  return std::ranges::any_of(
      column.cells, [](const Cell& cell) { return std::holds_alternative<std::string>(cell); });
}

void write_column(Hdf5Group& group, const SweepTable::Column& column) {
  if (has_text(column)) {
    std::vector<std::string> texts;
    for (const auto& cell : column.cells) {
      const auto* text = std::get_if<std::string>(&cell);
      texts.push_back(text != nullptr ? *text : csv_text(cell));
    }
    group.write_texts(column.name, texts);
    return;
  }
  std::vector<double> numbers;
  for (const auto& cell : column.cells) {
    const auto* number = std::get_if<double>(&cell);
    numbers.push_back(number != nullptr ? *number : unknown);
  }
  auto data = group.create_data<double>(column.name, {.rows = numbers.size()});
  data.write(std::span<const double>(numbers));
  if (!column.unit.empty()) data.set_attribute("unit", column.unit);
}

void write_contents(Hdf5Group root, const SweepTable& table, std::string_view sweep_file) {
  root.set_attribute("format", "riesel sweep");
  root.set_attribute("riesel_version", build_info().version);
  root.set_attribute("git_commit", build_info().git_commit);
  root.write_text("sweep_file", sweep_file);
  auto group = root.create_group("points");
  for (const auto& column : table.columns()) write_column(group, column);
}

}  // namespace

void SweepTable::set(std::size_t row, const std::string& column, Cell value,
                     const std::string& unit) {
  auto found = std::ranges::find(columns_, column, &Column::name);
  if (found == columns_.end()) {
    columns_.push_back({.name = column, .unit = unit, .cells = std::vector<Cell>(rows_)});
    found = columns_.end() - 1;
  }
  // Paths may be any bytes, but texts of HDF5 are read as UTF-8.
  if (auto* text = std::get_if<std::string>(&value)) *text = made_utf8(*text);
  found->cells.at(row) = std::move(value);
}

std::vector<std::pair<std::string, Cell>> flat_summary(const std::filesystem::path& path) {
  const std::string remedy = remedy_for_summary(path);
  const auto json = read_json(path, {.unreadable = remedy, .damaged = remedy});
  if (!json.is_object()) throw FileError(path, "is not a summary of a run", remedy);
  std::vector<std::pair<std::string, Cell>> values;
  try {
    flatten(json, "", values);
  } catch (const Json::exception& error) {
    throw FileError(path, fmt::format("is damaged ({})", flaw_of(error)), remedy);
  }
  return values;
}

std::string to_csv(const SweepTable& table) {
  std::string csv;
  const auto add_line = [&](const auto& text_of_column) {
    for (std::size_t i = 0; i < table.columns().size(); ++i) {
      csv += (i > 0 ? "," : "") + text_of_column(table.columns()[i]);
    }
    csv += "\n";
  };
  add_line([](const auto& column) { return csv_text(column.name); });
  for (std::size_t row = 0; row < table.rows(); ++row) {
    add_line([&](const auto& column) { return csv_text(column.cells[row]); });
  }
  return csv;
}

void write_hdf5(const std::filesystem::path& path, const SweepTable& table,
                std::string_view sweep_file) {
  auto file = Hdf5File::create();
  try {
    write_contents(file.root(), table, sweep_file);
  } catch (const Hdf5Error& error) {
    throw FileError(path, fmt::format("cannot hold the table ({})", error.what()),
                    "remove the point whose summary.json has such a name, and run it again");
  }
  const auto image = file.image();
  write_durably(path, std::string_view(image.data(), image.size()));
}

}  // namespace riesel::io
