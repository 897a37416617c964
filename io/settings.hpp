// The settings of a run: a YAML file, checked against the table of its scenario and turned into SI
// values.
//
// All of the file is checked before anything is handed out, so that the values that a scenario
// reads exist, have the right kind, lie in their range and are in SI units. Conditions between
// several settings are left to the scenario; it reports a violation through reject(), which points
// at the place in the user's file.
#pragma once

#include "io/settings_error.hpp"
#include "io/settings_table.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace riesel::io {

struct SettingsContents;
struct YamlEntry;
struct YamlNode;

/// Keeps a reference to the tables that it is read with: they must outlive it and its copies.
class Settings {
public:
  /// Reads a file. `overrides` are "key=value" with the value in YAML's flow style; they replace or
  /// add to what the file says, the last one for a key wins; "key=" removes the key. Throws
  /// SettingsError.
  static Settings from_file(const std::filesystem::path& file, const SettingsTables& tables,
                            const std::vector<std::string>& overrides = {});

  /// The same from text; `source` stands for the file in errors.
  static Settings from_text(const std::string& text, const std::string& source,
                            const SettingsTables& tables,
                            const std::vector<std::string>& overrides = {});

  /// The same from a map that was parsed before, and from overrides with dotted keys that carry the
  /// place where they were written. Has no source_text().
  static Settings from_yaml(const YamlNode& file, const SettingsTables& tables,
                            const std::vector<YamlEntry>& overrides);

  const std::string& scenario() const;

  /// Values in the SI unit of the table. Asking for a key that is not in the table, is of another
  /// kind, or has no value (see has()) is a mistake of the program: throws std::logic_error.
  double number(const std::string& key) const;
  std::int64_t integer(const std::string& key) const;
  const std::string& text(const std::string& key) const;                      ///< choices too
  const std::vector<double>& numbers(const std::string& key) const;           ///< never empty
  std::optional<std::int64_t> integer_or_auto(const std::string& key) const;  ///< nothing: auto

  bool has(const std::string& key) const;    ///< given or by default
  bool given(const std::string& key) const;  ///< by the file or an override

  /// Throws the SettingsError "key: problem; remedy" at the key; if that was not given, at its
  /// section or the file.
  [[noreturn]] void reject(const std::string& key, const std::string& problem,
                           const std::string& remedy) const;

  /// Rejects unless one and only one of the keys has a value.
  void require_exactly_one(const std::vector<std::string>& keys) const;

  /// A settings file that gives the same values, bit by bit: each one written out in SI units,
  /// defaults included.
  std::string effective_yaml() const;

  /// The part of it that belongs to the wanted rows of the table.
  std::string effective_yaml(const std::function<bool(const Setting&)>& wanted) const;

  /// The keys of the wanted rows that have a value.
  std::vector<std::string> keys(const std::function<bool(const Setting&)>& wanted) const;

  /// The value of a key of any kind as effective.yaml writes it; empty if it has none.
  std::string written(const std::string& key) const;

  /// The SI unit of a key's value, "1" for pure numbers; empty if it has none, or no value. It may
  /// depend on other settings, as that of a stiffness on the contact law.
  std::string unit(const std::string& key) const;

  /// The file verbatim, without the overrides.
  const std::string& source_text() const;

private:
  explicit Settings(SettingsContents contents);

  /// Shared by copies, as it never changes.
  std::shared_ptr<const SettingsContents> contents_;
};

}  // namespace riesel::io
