#include "io/sweep_file.hpp"

#include "io/settings_given.hpp"
#include "io/settings_names.hpp"
#include "io/settings_text.hpp"
#include "io/settings_value.hpp"
#include "io/sweep_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

namespace riesel::io {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string>& known_keys() {
  static const std::vector<std::string> keys = {"base",  "set",      "axes",
                                                "seeds", "branches", "continue_along"};
  return keys;
}

std::string unknown_key_remedy(const std::string& key) {
  if (key == "scenario") {
    return "this is a settings file: use 'riesel run', or name it as the base of a sweep";
  }
  return did_you_mean(key, known_keys())
      .value_or("the keys of a sweep are " + enumerate(known_keys()));
}

void refuse_unknown_keys(const YamlNode& file) {
  for (const auto& entry : file.entries) {
    if (std::ranges::find(known_keys(), entry.key) != known_keys().end()) continue;
    throw SettingsError(entry.key_place, entry.key, "unknown key", unknown_key_remedy(entry.key));
  }
}

void read_base(const YamlNode& file, SweepFile& sweep) {
  const auto* entry = find_entry(file, "base");
  if (entry == nullptr) {
    throw SettingsError({sweep.source, 1, 1}, "base", "is missing",
                        "give the path of a settings file, or settings");
  }
  const auto& base = entry->value;
  if (base.shape == YamlNode::Shape::map) {
    sweep.base = base;
  } else if (base.shape == YamlNode::Shape::scalar && !base.scalar.empty()) {
    const auto path = fs::path(sweep.source).parent_path() / base.scalar;
    std::string text;
    try {
      text = read_settings_text(path);
    } catch (const SettingsError& error) {
      throw SettingsError(base.place, "base", fmt::format("{} {}", path.string(), error.problem()),
                          "give the path of a settings file, relative to the sweep file");
    }
    sweep.base = parse_settings_yaml(text, path.string());
  } else {
    throw SettingsError(base.place, "base",
                        "expected the path of a settings file, or settings, got " + describe(base),
                        "write 'base: tube.yaml'");
  }
}

/// The entries of a map of overrides.
std::vector<YamlEntry> read_overrides(const YamlNode& node, const std::string& name) {
  if (node.shape != YamlNode::Shape::map) {
    throw SettingsError(node.place, name, "expected keys with values, got " + describe(node),
                        "write '{contact.friction: 0.3}', with dotted keys");
  }
  return node.entries;
}

std::vector<SweepBranch> read_branches(const YamlNode& node) {
  if (node.shape != YamlNode::Shape::map || node.entries.empty()) {
    throw SettingsError(node.place, "branches",
                        "expected named sets of overrides, got " + describe(node),
                        "write for instance '{slow: {start.axial_velocity: 1 m/s}}'");
  }
  std::vector<SweepBranch> branches;
  for (const auto& entry : node.entries) {
    if (entry.key.empty()) {
      throw SettingsError(entry.key_place, "branches", "a branch has no name",
                          "give it one, which tables and figures can show");
    }
    branches.push_back({entry.key, read_overrides(entry.value, "branches." + entry.key)});
  }
  return branches;
}

/// A list of seeds, or how many: 3 stands for 1, 2 and 3.
std::vector<YamlEntry> read_seeds(const YamlNode& node) {
  std::vector<YamlEntry> seeds;
  if (node.shape == YamlNode::Shape::list) {
    for (const auto& item : node.items) seeds.push_back({"seed", item.place, item});
    if (seeds.empty()) {
      throw SettingsError(node.place, "seeds", "the list is empty", "give at least one seed");
    }
    return seeds;
  }
  const Setting row = {.key = "seeds", .kind = Kind::integer, .range = between(1, most_seeds)};
  const auto count = std::get<std::int64_t>(read_value(row, node));
  for (std::int64_t seed = 1; seed <= count; ++seed) {
    seeds.push_back({"seed", node.place, scalar_node(node.place, std::to_string(seed))});
  }
  return seeds;
}

SweepContinuation read_continuation(const YamlNode& node, const std::vector<SweepAxis>& axes) {
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    for (const auto& key : axes[i].keys) {
      if (key == node.scalar) return {.axis = i, .place = node.place};
      keys.push_back(key);
    }
  }
  throw SettingsError(node.place, "continue_along",
                      "expected the key of an axis, got " + describe(node),
                      keys.empty() ? "give the sweep an axis" : "choose " + enumerate(keys));
}

/// Where each key is set, in the order in which the places are applied: of two that set it, one
/// would hide the other. So would one that takes out the section of an earlier one.
class Claims {
public:
  void claim(const std::string& key, const Place& place) {
    for (const auto& [other, first] : places_)
      if (key == other || other.starts_with(key + "."))
        throw SettingsError(place, key, fmt::format("is set twice, first at {}", to_string(first)),
                            "remove one of the two");
    places_.emplace(key, place);
  }

private:
  std::map<std::string, Place> places_;
};

void refuse_conflicts(const SweepFile& sweep) {
  Claims claims;
  for (const auto& entry : sweep.overrides) claims.claim(entry.key, entry.key_place);
  for (const auto& axis : sweep.axes) {
    for (const auto& entry : axis.values.front()) claims.claim(entry.key, entry.key_place);
  }
  if (!sweep.seeds.empty()) claims.claim("seed", sweep.seeds.front().key_place);
  for (const auto& branch : sweep.branches) {
    Claims own = claims;
    for (const auto& entry : branch.overrides) own.claim(entry.key, entry.key_place);
  }
}

void refuse_varied_scenario(const std::vector<YamlEntry>& entries) {
  for (const auto& entry : entries) {
    if (entry.key != "scenario") continue;
    throw SettingsError(entry.key_place, "scenario", "cannot be changed by a sweep",
                        "choose another base, or write a sweep for each scenario");
  }
}

/// Finds unknown keys before any value is read.
GivenSettings gather(const SweepFile& sweep, const SettingsTables& tables) {
  auto entries = sweep.overrides;
  for (const auto& branch : sweep.branches) {
    entries.insert(entries.end(), branch.overrides.begin(), branch.overrides.end());
  }
  refuse_varied_scenario(entries);
  Mistakes mistakes;
  GivenSettings given = gather_settings(sweep.base, tables, entries, mistakes);
  mistakes.throw_if_any();
  return given;
}

}  // namespace

SweepFile read_sweep_file(const fs::path& file, const SettingsTables& tables) {
  return read_sweep_text(read_settings_text(file), file.string(), tables);
}

SweepFile read_sweep_text(const std::string& text, const std::string& source,
                          const SettingsTables& tables) {
  const auto file = parse_settings_yaml(text, source, "'base:' and the path of a settings file");
  refuse_unknown_keys(file);
  SweepFile sweep;
  sweep.source = source;
  sweep.text = text;
  read_base(file, sweep);
  if (const auto* set = find_entry(file, "set")) {
    sweep.overrides = read_overrides(set->value, "set");
  }
  if (const auto* branches = find_entry(file, "branches")) {
    sweep.branches = read_branches(branches->value);
  }
  if (const auto* seeds = find_entry(file, "seeds")) sweep.seeds = read_seeds(seeds->value);
  const auto given = gather(sweep, tables);
  sweep.scenario = given.scenario;
  if (const auto* axes = find_entry(file, "axes")) {
    sweep.axes = read_axes(axes->value, given, tables);
  }
  refuse_conflicts(sweep);
  if (const auto* key = find_entry(file, "continue_along")) {
    sweep.continuation = read_continuation(key->value, sweep.axes);
  }
  return sweep;
}

}  // namespace riesel::io
