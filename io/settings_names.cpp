#include "io/settings_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace riesel::io {
namespace {

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The optimal string alignment distance (Damerau-Levenshtein without repeated edits), three rows
/// at a time.
std::size_t typing_errors(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_previous;
  std::vector<std::size_t> previous(b.size() + 1);
  std::iota(previous.begin(), previous.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> current(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) current[j] = std::min(current[j], before_previous[j - 2] + 1);
    }
    before_previous = std::move(previous);
    previous = std::move(current);
  }
  return previous.back();
}

std::vector<std::string> sections_with(const std::string& name, const SettingsTable& table) {
  std::vector<std::string> sections;
  for (const auto& row : table) {
    const auto section = section_of(row.key);
    const bool is_new = std::ranges::find(sections, section) == sections.end();
    if (!section.empty() && name_in_section(row.key) == name && is_new) sections.push_back(section);
  }
  return sections;
}

/// For a correct key in the wrong section.
std::optional<std::string> misplaced_remedy(const std::string& key, const SettingsTable& table) {
  const auto name = name_in_section(key);
  if (name != key && has_key(table, name)) {
    return fmt::format("'{}' belongs at the top level, outside of any section", name);
  }
  if (const auto sections = sections_with(name, table); !sections.empty()) {
    return fmt::format("'{}' belongs in the section {}", name, enumerate(sections));
  }
  return {};
}

/// For a key or section that another scenario has.
std::optional<std::string> other_scenario_remedy(const std::string& key,
                                                 const std::string& scenario,
                                                 const SettingsTables& tables) {
  std::vector<std::string> others;
  for (const auto& [name, table] : tables) {
    if (has_key(table, key) || has_section(table, key)) others.push_back(name);
  }
  if (others.empty()) return {};
  return fmt::format("remove it: the scenario {} does not have it (only {} does)", scenario,
                     enumerate(others));
}

std::string question(const std::string& name) { return fmt::format("did you mean '{}'?", name); }

std::optional<std::string> mistyped_remedy(const std::string& key, const SettingsTable& table) {
  const auto section = section_of(key);
  if (const auto nearest = nearest_name(name_in_section(key), names_of(table, section))) {
    return question(key_of(section, *nearest));
  }
  std::vector<std::string> names;
  for (const auto& row : table) names.push_back(name_in_section(row.key));
  if (const auto nearest = nearest_name(name_in_section(key), names)) {
    const auto row = std::ranges::find(
        table, *nearest, [](const Setting& candidate) { return name_in_section(candidate.key); });
    return question(row->key);
  }
  return {};
}

/// For text that is not a key: YAML has split something else.
std::optional<std::string> yaml_remedy(const std::string& key) {
  const auto name = name_in_section(key);
  if (const auto colon = name.find(':'); colon != std::string::npos && colon + 1 < name.size()) {
    return fmt::format("put a space after the colon: '{}: {}'", name.substr(0, colon),
                       name.substr(colon + 1));
  }
  if (!name.empty() && std::isdigit(static_cast<unsigned char>(name.front())) != 0) {
    return "a comma begins the next key; write a decimal point, as in 0.92";
  }
  return {};
}

}  // namespace

std::optional<std::string> nearest_name(const std::string& name,
                                        const std::vector<std::string>& candidates) {
  constexpr std::size_t longest_name = 64;  // nothing longer is a typing error of a key
  if (name.size() > longest_name) return {};
  std::optional<std::string> nearest;
  std::size_t fewest_errors = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const auto& candidate : candidates) {
    const auto errors = typing_errors(lower_case(name), lower_case(candidate));
    if (errors < fewest_errors) {
      fewest_errors = errors;
      nearest = candidate;
    }
  }
  return nearest;
}

std::optional<std::string> did_you_mean(const std::string& name,
                                        const std::vector<std::string>& candidates) {
  const auto nearest = nearest_name(name, candidates);
  return nearest ? std::optional(question(*nearest)) : std::nullopt;
}

std::string enumerate(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 == names.size() ? " or " : ", ";
    list += names[i];
  }
  return list;
}

std::string unknown_key_remedy(const std::string& key, const std::string& scenario,
                               const SettingsTables& tables) {
  const auto& table = tables.at(scenario);
  if (const auto remedy = yaml_remedy(key)) return *remedy;
  if (const auto remedy = misplaced_remedy(key, table)) return *remedy;
  if (const auto remedy = other_scenario_remedy(key, scenario, tables)) return *remedy;
  if (const auto remedy = mistyped_remedy(key, table)) return *remedy;
  const auto section = section_of(key);
  if (section.empty() || !has_section(table, section))
    return "expected " + enumerate(names_of(table, ""));
  return fmt::format("the keys of {} are {}", section, enumerate(names_of(table, section)));
}

}  // namespace riesel::io
