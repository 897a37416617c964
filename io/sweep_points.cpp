#include "io/sweep_points.hpp"

#include "io/content_hash.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace riesel::io {
namespace {

// The settings by which scenarios continue another run; see scenarios/continued_start.hpp.
constexpr auto start_section = "start";
constexpr auto start_kind = "start.kind";

/// Indices: of the place on each axis, of the branch, and of the seed.
using Combination = std::vector<std::size_t>;

/// All combinations of 0 ... count - 1 for each of the counts, the last one fastest.
std::vector<Combination> combinations_of(const std::vector<std::size_t>& counts) {
  std::vector<Combination> all = {{}};
  for (const auto count : counts) {
    std::vector<Combination> longer;
    for (const auto& combination : all) {
      for (std::size_t i = 0; i < count; ++i) {
        longer.push_back(combination);
        longer.back().push_back(i);
      }
    }
    all = std::move(longer);
  }
  return all;
}

class Expansion {
public:
  Expansion(const SweepFile& sweep, const SettingsTables& tables) : sweep_(sweep), tables_(tables) {
    for (const auto& axis : sweep.axes) counts_.push_back(axis.values.size());
    counts_.push_back(std::max<std::size_t>(1, sweep.branches.size()));
    counts_.push_back(std::max<std::size_t>(1, sweep.seeds.size()));
    check_number();
    check_continuation();
  }

  std::vector<SweepPoint> points() {
    auto counts = counts_;
    if (sweep_.continuation) counts[sweep_.continuation->axis] = 1;
    for (const auto& combination : combinations_of(counts)) {
      if (sweep_.continuation) {
        add_chain(combination);
      } else {
        add_point(combination);
      }
    }
    return std::move(points_);
  }

private:
  void check_number() const {
    std::size_t number = 1;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const bool both_ways = sweep_.continuation && sweep_.continuation->axis == i;
      number =
          std::min(number * (both_ways ? 2 * counts_[i] - 1 : counts_[i]), most_sweep_points + 1);
    }
    if (number <= most_sweep_points) return;
    throw SettingsError({sweep_.source, 1, 1}, "axes",
                        fmt::format("the sweep has more than {} points", most_sweep_points),
                        "split it");
  }

  void check_continuation() const {
    if (!sweep_.continuation || has_key(tables_.at(sweep_.scenario), start_kind)) return;
    throw SettingsError(
        sweep_.continuation->place, "continue_along",
        fmt::format("the runs of the scenario {} cannot continue each other", sweep_.scenario),
        "remove the key");
  }

  std::vector<YamlEntry> overrides_of(const Combination& combination) const {
    auto entries = sweep_.overrides;
    const auto add = [&](const std::vector<YamlEntry>& more) {
      entries.insert(entries.end(), more.begin(), more.end());
    };
    const auto axes = sweep_.axes.size();
    for (std::size_t i = 0; i < axes; ++i) add(sweep_.axes[i].values[combination[i]]);
    if (!sweep_.branches.empty()) add(sweep_.branches[combination[axes]].overrides);
    if (!sweep_.seeds.empty()) entries.push_back(sweep_.seeds[combination[axes + 1]]);
    return entries;
  }

  Settings settings_of(const Combination& combination) const {
    return Settings::from_yaml(sweep_.base, tables_, overrides_of(combination));
  }

  std::string branch_of(const Combination& combination) const {
    return sweep_.branches.empty() ? "" : sweep_.branches[combination[sweep_.axes.size()]].name;
  }

  /// What the results depend on: a text of the wanted settings that matter, and of the content of
  /// files that they name, in the order of the settings; and these files, with that content.
  struct Identity {
    std::string text;
    std::map<std::string, std::string> inputs;
  };

  template <class Wanted>
  Identity identity_of(const Settings& settings, Wanted wanted) {
    Identity identity{.text = settings.effective_yaml([&](const Setting& row) {
                        return row.matters && !row.names_content && wanted(row);
                      }),
                      .inputs = {}};
    for (const std::string& key :
         settings.keys([&](const Setting& row) { return row.names_content && wanted(row); })) {
      const std::string& file = settings.text(key);
      const auto [known, is_new] = contents_.try_emplace(file);
      if (is_new) known->second = hash_of_content(file);
      identity.text += known->second;
      identity.inputs.insert(*known);
    }
    return identity;
  }

  void add_point(const Combination& combination) {
    auto settings = settings_of(combination);
    auto identity = identity_of(settings, [](const Setting&) { return true; });
    auto yaml = settings.effective_yaml();
    points_.push_back({.settings = std::move(settings),
                       .yaml = std::move(yaml),
                       .name = hash_of_text(identity.text),
                       .parent = {},
                       .branch = branch_of(combination),
                       .leg = "",
                       .inputs = std::move(identity.inputs)});
  }

  /// The same, starting from the final state of the point before.
  void add_continued_point(const Combination& combination, const std::string& leg) {
    auto settings = settings_of(combination);
    const auto parent = points_.size() - 1;
    const auto& parents_name = points_[parent].name;
    auto identity = identity_of(settings, [](const Setting& row) { return !is_of_start(row.key); });
    auto yaml = settings.effective_yaml([](const Setting& row) { return !is_of_start(row.key); });
    yaml += fmt::format("\n{}:\n  kind: continued\n  from: ../{}\n", start_section, parents_name);
    points_.push_back({.settings = std::move(settings),
                       .yaml = std::move(yaml),
                       .name = hash_of_text(identity.text + "continued from " + parents_name),
                       .parent = parent,
                       .branch = branch_of(combination),
                       .leg = leg,
                       .inputs = std::move(identity.inputs)});
  }

  void add_chain(Combination combination) {
    auto& place = combination[sweep_.continuation->axis];
    const auto last = counts_[sweep_.continuation->axis] - 1;
    place = 0;
    add_point(combination);
    points_.back().leg = "forward";
    for (place = 1; place <= last; ++place) add_continued_point(combination, "forward");
    for (place = last; place-- > 0;) add_continued_point(combination, "backward");
  }

  const SweepFile& sweep_;
  const SettingsTables& tables_;
  std::vector<std::size_t> counts_;              // places on each axis, branches, seeds
  std::map<std::string, std::string> contents_;  // of files, as hashes
  std::vector<SweepPoint> points_;
};

bool differs(const std::string& key, const std::vector<SweepPoint>& points) {
  return std::ranges::any_of(points, [&](const auto& point) {
    return point.settings.written(key) != points.front().settings.written(key);
  });
}

}  // namespace

std::vector<SweepPoint> expand(const SweepFile& sweep, const SettingsTables& tables) {
  return Expansion(sweep, tables).points();
}

bool is_of_start(const std::string& key) { return section_of(key) == start_section; }

std::vector<std::string> varied_keys(const SweepFile& sweep, const SettingsTable& table,
                                     const std::vector<SweepPoint>& points) {
  std::vector<std::string> keys;
  const auto add = [&](const std::string& key) {
    if (key != "seed" && std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
  };
  const auto add_section = [&](const std::string& section) {
    for (const auto& row : table)
      if (row.key.starts_with(section + ".") && differs(row.key, points)) add(row.key);
  };
  for (const auto& axis : sweep.axes) std::ranges::for_each(axis.keys, add);
  for (const auto& branch : sweep.branches) {
    for (const auto& entry : branch.overrides)
      has_section(table, entry.key) ? add_section(entry.key) : add(entry.key);
  }
  keys.emplace_back("seed");
  return keys;
}

}  // namespace riesel::io
