#include "io/settings_reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace riesel::io {
namespace {

constexpr auto introduction = R"(# Settings

A settings file is YAML: sections with keys, as below. A key with a default may be left out; unknown keys are errors.

Where a quantity is expected, a number counts in the SI unit of the table, and a text such as `0.66 mm`, `2 kN/m`
or `5 %` is converted to it; a unit of another dimension is an error. Where a list of quantities is expected, all of
these are fine: `[0.1 m/s, 0.3 m/s]`, a single quantity, and `{from: 0.1 m/s, to: 40 m/s, points: 60, spacing: log}`
(or `spacing: linear`), which includes both ends.

On the command line, `--set contact.friction=0.3` replaces or adds a value, and `--set run.duration=` takes out one that
the file gives. A key with two dots is in a section of a section: `run: {until: {relative_error: 1 %, at_most: 20 s}}`.
)";

/// Quantities say their unit, numbers of other kinds their kind.
std::string kind_text(const Setting& row) {
  const auto unit = row.unit.empty() ? "SI number without unit" : row.unit;
  switch (row.kind) {
  case Kind::number:
    return row.unit == "1" ? "number" : unit;
  case Kind::numbers:
    return fmt::format("list of {}", row.unit == "1" ? "numbers" : unit);
  case Kind::integer:
    return "integer";
  case Kind::integer_or_auto:
    return "integer or `auto`";
  case Kind::choice:
    return fmt::format("`{}`", fmt::join(row.choices, "`, `"));
  case Kind::text:
    return "text";
  case Kind::path:
    return "path";
  case Kind::boolean:
    return "`true` or `false`";
  }
  return {};
}

std::string value_text(const Setting& row) {
  const auto range = to_string(row.range, "");
  return range.empty() ? kind_text(row) : fmt::format("{}, {}", kind_text(row), range);
}

std::string default_text(const Setting& row) {
  if (row.required) return "required";
  return row.fallback.empty() ? "" : fmt::format("`{}`", row.fallback);
}

std::string in_cell(std::string text) {
  for (auto bar = text.find('|'); bar != std::string::npos; bar = text.find('|', bar + 2)) {
    text.insert(bar, "\\");
  }
  return text;
}

std::string line(const Setting& row) {
  const auto condition =
      row.only_when ? fmt::format(" Only when {}.", to_string(*row.only_when)) : "";
  return fmt::format("| `{}` | {} | {} | {} |\n", row.key, in_cell(value_text(row)),
                     in_cell(default_text(row)), in_cell(row.doc + condition));
}

std::string table_text(const SettingsTable& rows) {
  std::string text = "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const auto& row : rows) text += line(row);
  return text;
}

/// The rows of a scenario's table whose key is in common_settings(), or not.
SettingsTable rows_of(const SettingsTable& table, bool common) {
  const auto all_share = common_settings();
  SettingsTable rows;
  std::ranges::copy_if(table, std::back_inserter(rows),
                       [&](const Setting& row) { return has_key(all_share, row.key) == common; });
  return rows;
}

}  // namespace

std::string settings_reference(const SettingsTables& tables) {
  std::string page = introduction;
  page += "\n## All scenarios\n\n" + table_text(rows_of(tables.begin()->second, true));
  for (const auto& [scenario, table] : tables) {
    page += fmt::format("\n## Scenario `{}`\n\n", scenario) + table_text(rows_of(table, false));
  }
  return page;
}

}  // namespace riesel::io
