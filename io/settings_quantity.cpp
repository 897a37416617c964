#include "io/settings_quantity.hpp"

#include "io/settings_names.hpp"
#include "io/settings_value.hpp"
#include "io/settings_yaml.hpp"
#include "io/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace riesel::io {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The remedy for a text that does not even begin with a number.
std::string no_numeral_remedy(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto* name : {"inf", "nan"}) {
    if (text.find(name) <= 2) return "give a finite number";
  }
  return "begin with the number, as in the example";
}

/// Some readers of YAML take 017 for 15, others for 17.
bool has_leading_zero(std::string_view numeral) {
  if (numeral.starts_with('-')) numeral.remove_prefix(1);
  return numeral.size() > 1 && numeral[0] == '0' && is_digit(numeral[1]);
}

/// The remedy for numbers written as in other countries or in programs; empty if the number is not
/// one of these.
std::string odd_numeral_remedy(const QuantityText& quantity) {
  if (has_leading_zero(quantity.numeral))
    return "remove the leading zero: some programs read it as octal";
  if (quantity.unit.empty() || quantity.unit.starts_with("1/")) return "";
  const char next = quantity.unit.front();
  if (next == ',') return "write a decimal point, and no separators of thousands";
  if (next == '_' || is_digit(next)) return "write the digits without separators";
  if (quantity.numeral == "0" && quantity.unit.size() > 1 && (next == 'x' || next == 'o')) {
    return "write a decimal number";
  }
  return "";
}

/// The rows of {from, to, points, spacing}, so that its parts are read and checked like any other
/// setting.
SettingsTable span_rows(const Setting& row) {
  SettingsTable rows(2, row);
  rows[0].key = row.key + ".from";
  rows[1].key = row.key + ".to";
  for (auto& end : rows) end.kind = Kind::number;
  rows.push_back(
      {.key = row.key + ".points", .kind = Kind::integer, .range = between(2, most_values)});
  rows.push_back({.key = row.key + ".spacing", .kind = Kind::choice, .choices = {"log", "linear"}});
  return rows;
}

void refuse_unknown_entries(const Setting& row, const YamlNode& map) {
  const std::vector<std::string> known = {"from", "to", "points", "spacing"};
  for (const auto& entry : map.entries) {
    if (std::ranges::find(known, entry.key) != known.end()) continue;
    throw SettingsError(entry.key_place, row.key + "." + entry.key, "unknown key",
                        did_you_mean(entry.key, known)
                            .value_or("the keys of a range are from, to, points and spacing"));
  }
}

SettingValue read_span_entry(const Setting& entry_row, const YamlNode& map) {
  const auto* entry = find_entry(map, name_in_section(entry_row.key));
  if (entry == nullptr) {
    throw SettingsError(map.place, entry_row.key, "is missing",
                        fmt::format("give {}", expectation(entry_row)));
  }
  return read_value(entry_row, entry->value);
}

/// Values at equal distances, or at equal ratios; both ends are exact.
std::vector<double> spread(double from, double to, std::int64_t points, bool logarithmic) {
  std::vector<double> values;
  for (std::int64_t i = 0; i < points; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(points - 1);
    const double value =
        logarithmic ? std::exp(std::lerp(std::log(from), std::log(to), t)) : std::lerp(from, to, t);
    values.push_back(std::clamp(value, std::min(from, to), std::max(from, to)));
  }
  values.front() = from;
  values.back() = to;
  return values;
}

std::vector<double> read_span(const Setting& row, const YamlNode& map) {
  refuse_unknown_entries(row, map);
  const auto rows = span_rows(row);
  const auto from = std::get<double>(read_span_entry(rows[0], map));
  const auto to = std::get<double>(read_span_entry(rows[1], map));
  const auto points = std::get<std::int64_t>(read_span_entry(rows[2], map));
  const bool logarithmic = std::get<std::string>(read_span_entry(rows[3], map)) == "log";
  if (from == to) {
    throw SettingsError(map.place, row.key, "from and to are equal", "give the one value alone");
  }
  if (logarithmic && !(from > 0.0 && to > 0.0)) {
    throw SettingsError(map.place, row.key, "a logarithmic range needs both ends above 0",
                        "choose 'spacing: linear', or move the end");
  }
  return spread(from, to, points, logarithmic);
}

std::vector<double> read_list(const Setting& row, const YamlNode& list) {
  if (list.items.empty()) {
    throw SettingsError(list.place, row.key, "the list is empty", "give at least one value");
  }
  if (std::cmp_greater(list.items.size(), most_values)) {
    throw SettingsError(list.place, row.key,
                        fmt::format("the list has {} values, at most {} are allowed",
                                    list.items.size(), most_values),
                        "split it over several runs");
  }
  auto item_row = row;
  item_row.kind = Kind::number;
  std::vector<double> values;
  for (const auto& item : list.items) values.push_back(read_quantity(item_row, item));
  return values;
}

}  // namespace

std::string expected_quantity(const Setting& row) {
  const auto [noun, example] = describe_unit(row.unit);
  if (row.unit.empty()) return fmt::format("an SI number such as '{}', without a unit", example);
  if (row.unit == "1") return fmt::format("{} such as '{}' or '5 %'", noun, example);
  return fmt::format("{} such as '{}' or a number in {}", noun, example, row.unit);
}

double read_quantity(const Setting& row, const YamlNode& node) {
  if (node.shape != YamlNode::Shape::scalar) refuse_value(row, node, "give a single value");
  const auto quantity = split_quantity(node.scalar);
  if (!quantity) refuse_value(row, node, no_numeral_remedy(node.scalar));
  if (const auto remedy = odd_numeral_remedy(*quantity); !remedy.empty())
    refuse_value(row, node, remedy);
  if (row.unit.empty() && !quantity->unit.empty()) refuse_value(row, node, "leave the unit out");

  std::optional<double> value;
  try {
    value = value_in_si(*quantity, row.unit);
  } catch (const UnitError& error) {
    refuse_value(row, node, error.what());
  }
  if (!value) refuse_value(row, node, "give a value that a double-precision number can hold");
  check_range(row, node, *value);
  return *value;
}

std::vector<double> read_quantities(const Setting& row, const YamlNode& node) {
  switch (node.shape) {
  case YamlNode::Shape::list:
    return read_list(row, node);
  case YamlNode::Shape::map:
    return read_span(row, node);
  default:
    return {read_quantity(row, node)};
  }
}

}  // namespace riesel::io
