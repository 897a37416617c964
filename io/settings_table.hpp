// The table of settings: one row per key holds all that is known about it, its kind, unit, default,
// range and meaning.
//
// Everything that deals with settings works from these rows: reading and checking a file, the
// errors, the recorded effective.yaml and the reference page of the manual. So a new setting is one
// new row, and these cannot contradict each other. The rows that all scenarios share are in
// common_settings(); a scenario appends its own.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace riesel::io {

enum class Kind {
  number,   ///< a quantity: "0.66 mm" or an SI number
  integer,  ///< fits into 64 bits
  choice,   ///< one of Setting::choices
  text,     ///< not empty
  path,     ///< of a file or directory; relative to the settings file that gives it
  numbers,  ///< a list of quantities, one quantity, or {from, to, points, spacing: log | linear}
  integer_or_auto,  ///< an integer or the word auto
};

/// The values a number may take.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< `low` itself is out of range
  bool high_open = false;  ///< `high` itself is out of range

  bool contains(double value) const;
};
Range any();
Range positive();
Range non_negative();
Range at_least(double low);
Range between(double low, double high);      ///< both ends included
Range above_up_to(double low, double high);  ///< `low` excluded, `high` included

/// The condition that an earlier setting of kind choice has one of these values.
struct When {
  std::string key;
  std::vector<std::string> values;
};

/// One row of the table. Two rows may have the same key if their conditions exclude each other:
/// that is how the unit of a contact law's stiffness depends on the law.
struct Setting {
  std::string key = {};  ///< "name", "section.name" or "section.subsection.name"
  Kind kind = Kind::number;
  std::string unit = {};      ///< SI unit of the stored value, "1" for pure numbers; empty: an SI
                              ///< number, for which no unit is accepted
  std::string fallback = {};  ///< the default as YAML text; empty: none
  /// The value in a new file, where there is no default or it would not do.
  std::string starter = {};
  std::string example = {};  ///< without a default: the value in a new file, in a comment
  bool required = false;     ///< an error if not given (and if `only_when` holds)
  Range range = {};
  std::vector<std::string> choices = {};
  std::string doc = {};  ///< for the reference page; ends with a full stop
  /// The row applies only under this condition, and under that of the row it refers to.
  std::optional<When> only_when = {};
  bool matters = true;  ///< the results depend on it
  /// Of a path: the results depend on what the file contains, not on its name.
  bool names_content = false;
};

using SettingsTable = std::vector<Setting>;

/// The whole table of each scenario (common rows included), by the scenario's name.
using SettingsTables = std::map<std::string, SettingsTable>;

std::vector<std::string> names_of_scenarios(const SettingsTables& tables);

/// The rows of all scenarios: scenario, seed, grains.rotation, contact.*, run.*.
SettingsTable common_settings();

/// The most that `run.threads` accepts.
inline constexpr int most_threads = 1024;

/// Throws std::logic_error if a row contradicts itself or another one (a mistake in the code, not
/// in a user's file).
void verify_table(const SettingsTable& table);

/// The part of a key before the last dot; empty for a key at the top level. Likewise the section
/// that a section is in.
std::string section_of(const std::string& key);
/// The part of a key after the last dot.
std::string name_in_section(const std::string& key);
/// The key of a name in a section, which is empty for the top level.
std::string key_of(const std::string& section, const std::string& name);

bool has_key(const SettingsTable& table, const std::string& key);
bool has_section(const SettingsTable& table, const std::string& section);

/// The names within a section, including those of its own sections, in table order, each once; for
/// "", the names at the top level of a file.
std::vector<std::string> names_of(const SettingsTable& table, const std::string& section);

/// The condition under which any row of this key applies; nothing if there is none.
std::optional<When> condition_of(const SettingsTable& table, const std::string& key);

/// "above 0 m", "from 1 to 1024", ...; for angles in degrees; empty if there is no limit.
std::string to_string(const Range& range, const std::string& unit);
/// "contact.law is power or hertz"
std::string to_string(const When& when);

}  // namespace riesel::io
