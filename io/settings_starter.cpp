#include "io/settings_starter.hpp"

#include "io/settings_given.hpp"
#include "io/settings_quantity.hpp"
#include "io/settings_value.hpp"
#include "io/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace riesel::io {
namespace {

std::string indent(const std::string& section) {
  if (section.empty()) return "";
  const auto depth = 1 + std::ranges::count(section, '.');
  return fmt::format("{:{}}", "", 2 * depth);
}

/// Comment lines of at most 100 characters.
std::string comment(const std::string& text, const std::string& indent) {
  constexpr std::size_t width = 100;
  const std::string beginning = indent + "#";
  std::string lines, line = beginning, word;
  for (std::istringstream words(text); words >> word;) {
    if (line.size() + 1 + word.size() > width) {
      lines += line + "\n";
      line = beginning;
    }
    line += " " + word;
  }
  return lines + line + "\n";
}

class Starter {
public:
  explicit Starter(const SettingsTable& table) : table_(&table) {}

  std::string section(const std::string& path) const {
    std::string text;
    for (const std::string& part : names_of(*table_, path)) {
      const std::string key = key_of(path, part);
      if (has_section(*table_, key)) {
        text += (path.empty() ? "\n" : "") + setting(key, "", is_given(key)) + section(key);
        continue;
      }
      for (const Setting& row : *table_)
        if (row.key == key && key != "scenario") text += described(row);
    }
    return text;
  }

private:
  /// All choices have their defaults.
  bool counts(const Setting& row) const { return may_count(row, {}, *table_); }

  bool gives(const Setting& row) const { return counts(row) && !row.starter.empty(); }

  /// Whether the file gives any setting of the section.
  bool is_given(const std::string& section) const {
    return std::ranges::any_of(*table_, [&](const Setting& row) {
      return row.key.starts_with(section + ".") && gives(row);
    });
  }

  /// A line, with a # in the first column if the setting is not given.
  static std::string setting(const std::string& key, const std::string& value, bool given) {
    return fmt::format("{}{}{}:{}{}\n", given ? "" : "#", indent(section_of(key)),
                       name_in_section(key), value.empty() ? "" : " ", value);
  }

  static std::string value_of(const Setting& row) {
    for (const auto& value : {row.starter, row.fallback})
      if (!value.empty()) return value;
    if (!row.example.empty()) return row.example + "  # for example";
    if (row.kind == Kind::number || row.kind == Kind::numbers)
      return example_of(row) + "  # for example";
    return "...";
  }

  /// Within the range: a number without a unit may be a fraction or a multiple, so that the usual
  /// example does not always fit.
  static std::string example_of(const Setting& row) {
    const std::string example = describe_unit(row.unit).example;
    const bool is_pure = example.find(' ') == std::string::npos;
    return is_pure && !row.range.contains(decimal_value(example).value())
               ? fmt::format("{}", row.range.low + 1.0)
               : example;
  }

  std::string described(const Setting& row) const {
    const std::string range = to_string(row.range, row.unit);
    std::string text = row.doc;
    if (row.kind == Kind::choice) text += fmt::format(" One of {}.", expectation(row));
    if (!range.empty()) text += fmt::format(" Range: {}.", range);
    if (row.only_when) text += fmt::format(" Only when {}.", to_string(*row.only_when));
    return comment(text, indent(section_of(row.key))) + setting(row.key, value_of(row), gives(row));
  }

  const SettingsTable* table_;
};

}  // namespace

std::string starter_file(const SettingsTable& table, const std::string& scenario,
                         const std::string& summary) {
  return comment(summary, "")
         + comment("Lines with a # in the first column show defaults or examples. To change one, "
                   "remove its #, and that of its section.",
                   "")
         + "scenario: " + scenario + "\n" + Starter(table).section("");
}

}  // namespace riesel::io
