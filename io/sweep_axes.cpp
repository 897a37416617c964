#include "io/sweep_axes.hpp"

#include "io/settings_names.hpp"
#include "io/settings_quantity.hpp"
#include "io/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace riesel::io {
namespace {

using Shape = YamlNode::Shape;

/// The values of a range, those between its ends to fourteen digits: a point is the same one in a
/// longer range, where rounding makes 0.42000000000000004 of 0.42, or 3e-17 of 0.
std::vector<double> without_rounding_noise(std::vector<double> values) {
  constexpr double rounding = 1e-14;
  const double largest = std::max(std::abs(values.front()), std::abs(values.back()));
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    values[i] = std::abs(values[i]) < rounding * largest
                    ? 0.0
                    : decimal_value(fmt::format("{:.14g}", values[i])).value_or(values[i]);
  return values;
}

class AxisReader {
public:
  AxisReader(const GivenSettings& given, const SettingsTables& tables)
      : given_(given), tables_(tables), table_(tables.at(given.scenario)) {}

  /// The keys of `map` vary together.
  SweepAxis zipped(const YamlNode& map) const {
    SweepAxis axis;
    for (const auto& entry : map.entries) add(entry, axis);
    return axis;
  }

  SweepAxis single(const YamlEntry& entry) const {
    SweepAxis axis;
    add(entry, axis);
    return axis;
  }

private:
  void add(const YamlEntry& entry, SweepAxis& axis) const {
    check_key(entry);
    const auto values = values_of(entry);
    if (axis.keys.empty()) {
      axis.values.resize(values.size());
    } else if (values.size() != axis.values.size()) {
      throw SettingsError(entry.value.place, entry.key,
                          fmt::format("has {} values, but {}, which varies with it, has {}",
                                      values.size(), axis.keys.front(), axis.values.size()),
                          "give both the same number, or make them two axes");
    }
    axis.keys.push_back(entry.key);
    for (std::size_t i = 0; i < values.size(); ++i) {
      axis.values[i].push_back({entry.key, entry.key_place, values[i]});
    }
  }

  void check_key(const YamlEntry& entry) const {
    if (entry.key == "scenario") {
      throw SettingsError(entry.key_place, entry.key, "cannot be changed by a sweep",
                          "write a sweep for each scenario");
    }
    if (has_section(table_, entry.key)) {
      throw SettingsError(entry.key_place, entry.key, "is a section and has no value of its own",
                          fmt::format("give a key of it, such as {}.{}", entry.key,
                                      names_of(table_, entry.key).front()));
    }
    if (has_key(table_, entry.key)) return;
    throw SettingsError(entry.key_place, entry.key, "unknown key",
                        unknown_key_remedy(entry.key, given_.scenario, tables_));
  }

  std::vector<YamlNode> values_of(const YamlEntry& entry) const {
    if (entry.value.shape == Shape::map) return spread(entry);
    if (entry.value.shape != Shape::list) {
      throw SettingsError(entry.value.place, entry.key,
                          "expected a list of values, got " + describe(entry.value),
                          "write '[..., ...]', or move the key to 'set'");
    }
    if (entry.value.items.empty()) {
      throw SettingsError(entry.value.place, entry.key, "the list is empty",
                          "give at least one value");
    }
    return entry.value.items;
  }

  /// {from, to, points, spacing}, in SI units.
  std::vector<YamlNode> spread(const YamlEntry& entry) const {
    const auto& row = row_of(entry.key);
    if (row.kind != Kind::number) {
      throw SettingsError(entry.value.place, entry.key, "only quantities can be given as a range",
                          "write the values as a list");
    }
    std::vector<YamlNode> values;
    for (const double value : without_rounding_noise(read_quantities(row, entry.value)))
      values.push_back(scalar_node(entry.value.place, fmt::format("{}", value)));
    return values;
  }

  /// Of the rows with this key, the one that applies; if none does, the first.
  const Setting& row_of(const std::string& key) const {
    const auto counts = [&](const Setting& row) {
      return row.key == key && may_count(row, given_, table_);
    };
    const auto row = std::ranges::find_if(table_, counts);
    return row != table_.end() ? *row : *std::ranges::find(table_, key, &Setting::key);
  }

  const GivenSettings& given_;
  const SettingsTables& tables_;
  const SettingsTable& table_;
};

}  // namespace

std::vector<SweepAxis> read_axes(const YamlNode& node, const GivenSettings& given,
                                 const SettingsTables& tables) {
  const AxisReader reader(given, tables);
  std::vector<SweepAxis> axes;
  if (node.shape == Shape::map && !node.entries.empty()) {
    for (const auto& entry : node.entries) axes.push_back(reader.single(entry));
    return axes;
  }
  const auto is_axis = [](const YamlNode& item) {
    return item.shape == Shape::map && !item.entries.empty();
  };
  if (node.shape != Shape::list || node.items.empty()
      || !std::ranges::all_of(node.items, is_axis)) {
    throw SettingsError(node.place, "axes",
                        "expected keys with their values, or a list of such maps, got "
                            + describe(node),
                        "write for instance '{contact.restitution: [0.8, 0.9]}'");
  }
  for (const auto& item : node.items) axes.push_back(reader.zipped(item));
  return axes;
}

}  // namespace riesel::io
