#include "io/settings_reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <string>
#include <vector>

namespace riesel::io {
namespace {

constexpr auto introduction = R"(# Settings

A settings file is YAML: sections with keys, as below. A key with a default may be left out; unknown keys are errors,
and so are keys without effect beside the others.

Where a quantity is expected, a number without a unit is in the SI unit given in the table, and a text such as
`0.66 mm`, `2 kN/m` or `5 %` is converted to it; a unit of another dimension is an error. Where a list of quantities is
expected, all of these are fine: `[0.1 m/s, 0.3 m/s]`, a single quantity, and
`{from: 0.1 m/s, to: 40 m/s, points: 60, spacing: log}` (or `spacing: linear`), which includes both ends.

On the command line, `--set contact.friction=0.3` replaces or adds a value, and `--set run.duration=` takes out one that
the file gives. A key with two dots is in a section of a section: `run: {until: {relative_error: 1 %, at_most: 20 s}}`.
)";

/// The unit of a quantity, the kind of any other value.
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
  }
  return {};
}

std::string value_text(const Setting& row) {
  // The kind gives the unit, except for angles, whose ranges are in degrees.
  const auto range = to_string(row.range, row.unit == "rad" ? row.unit : "");
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

using Names = std::vector<std::string>;

/// What more scenarios share comes first.
struct MostFirst {
  bool operator()(const Names& a, const Names& b) const {
    return a.size() == b.size() ? a < b : a.size() > b.size();
  }
};

/// Fewer shared lines do not get a section of their own: each scenario repeats them.
constexpr std::size_t least_shared = 3;

/// The lines of the tables, by the scenarios that share them.
std::map<Names, std::vector<std::string>, MostFirst> sections(const SettingsTables& tables) {
  std::map<std::string, Names> sharing;  // by line
  for (const auto& [scenario, table] : tables)
    for (const auto& row : table) sharing[line(row)].push_back(scenario);
  std::map<Names, std::size_t> shared;
  for (const auto& [text, scenarios] : sharing) ++shared[scenarios];

  std::map<Names, std::vector<std::string>, MostFirst> lines;
  for (const auto& [scenario, table] : tables)
    for (const auto& row : table) {
      const auto& scenarios = sharing.at(line(row));
      if (shared.at(scenarios) < least_shared)
        lines[{scenario}].push_back(line(row));
      else if (scenarios.front() == scenario)
        lines[scenarios].push_back(line(row));
    }
  return lines;
}

std::string title(const Names& scenarios, std::size_t all) {
  if (scenarios.size() == all) return "All scenarios";
  if (scenarios.size() == 1) return fmt::format("Scenario `{}`", scenarios.front());
  return fmt::format("Scenarios `{}`", fmt::join(scenarios, "`, `"));
}

}  // namespace

std::string settings_reference(const SettingsTables& tables) {
  std::string page = introduction;
  for (const auto& [scenarios, lines] : sections(tables))
    page += fmt::format("\n## {}\n\n| key | value | default | meaning |\n|---|---|---|---|\n{}",
                        title(scenarios, tables.size()), fmt::join(lines, ""));
  return page;
}

}  // namespace riesel::io
