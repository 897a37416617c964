#include "io/settings.hpp"

#include "io/settings_contents.hpp"
#include "io/settings_given.hpp"
#include "io/settings_names.hpp"
#include "io/settings_text.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace riesel::io {
namespace {

/// The value of a key that must have one, either because the table says so or because the caller
/// has asked has().
template <typename T>
const T& value_of(const SettingsContents& contents, const std::string& key) {
  const auto* entry = contents.find(key);
  if (entry == nullptr || !entry->value) {
    const auto* reason = has_key(*contents.table, key) ? "has no value" : "is not in the table";
    throw std::logic_error(fmt::format("setting {} {}", key, reason));
  }
  const auto* value = std::get_if<T>(&*entry->value);
  if (value == nullptr) throw std::logic_error(fmt::format("setting {} is of another kind", key));
  return *value;
}

void check_key(const SettingsContents& contents, const std::string& key) {
  if (!has_key(*contents.table, key)) {
    throw std::logic_error(fmt::format("setting {} is not in the table", key));
  }
}

}  // namespace

Settings::Settings(SettingsContents contents)
    : contents_(std::make_shared<const SettingsContents>(std::move(contents))) {}

Settings Settings::from_file(const std::filesystem::path& file, const SettingsTables& tables,
                             const std::vector<std::string>& overrides) {
  return from_text(read_settings_text(file), file.string(), tables, overrides);
}

Settings Settings::from_text(const std::string& text, const std::string& source,
                             const SettingsTables& tables,
                             const std::vector<std::string>& overrides) {
  SettingsContents contents =
      read_settings(parse_settings_yaml(text, source), tables, parse_overrides(overrides));
  contents.source_text = text;
  return Settings(std::move(contents));
}

Settings Settings::from_yaml(const YamlNode& file, const SettingsTables& tables,
                             const std::vector<YamlEntry>& overrides) {
  return Settings(read_settings(file, tables, overrides));
}

const std::string& Settings::scenario() const { return text("scenario"); }

double Settings::number(const std::string& key) const { return value_of<double>(*contents_, key); }

std::int64_t Settings::integer(const std::string& key) const {
  return value_of<std::int64_t>(*contents_, key);
}

const std::string& Settings::text(const std::string& key) const {
  return value_of<std::string>(*contents_, key);
}

const std::vector<double>& Settings::numbers(const std::string& key) const {
  return value_of<std::vector<double>>(*contents_, key);
}

std::optional<std::int64_t> Settings::integer_or_auto(const std::string& key) const {
  const auto* entry = contents_->find(key);
  if (entry != nullptr && entry->value == SettingValue(Auto{})) return {};
  return integer(key);
}

bool Settings::has(const std::string& key) const {
  check_key(*contents_, key);
  const auto* entry = contents_->find(key);
  return entry != nullptr && entry->value;
}

bool Settings::given(const std::string& key) const {
  check_key(*contents_, key);
  const auto* entry = contents_->find(key);
  return entry != nullptr && entry->given_at;
}

void Settings::reject(const std::string& key, const std::string& problem,
                      const std::string& remedy) const {
  check_key(*contents_, key);
  throw SettingsError(contents_->place_of(key), key, problem, remedy);
}

void Settings::require_exactly_one(const std::vector<std::string>& keys) const {
  std::vector<std::string> present;
  for (const auto& key : keys) {
    if (has(key)) present.push_back(key);
  }
  if (present.empty()) reject(keys.front(), "is missing", "give either " + enumerate(keys));
  if (present.size() > 1) {
    reject(present[1], fmt::format("cannot be given together with {}", present[0]),
           "remove one of the two");
  }
}

std::string Settings::effective_yaml() const {
  return effective_yaml([](const Setting&) { return true; });
}

std::string Settings::effective_yaml(const std::function<bool(const Setting&)>& wanted) const {
  return io::effective_yaml(*contents_, wanted);
}

std::vector<std::string> Settings::keys(const std::function<bool(const Setting&)>& wanted) const {
  std::vector<std::string> keys;
  for (const auto& entry : contents_->entries)
    if (entry.value && wanted(*entry.row)) keys.push_back(entry.row->key);
  return keys;
}

std::string Settings::written(const std::string& key) const {
  return has(key) ? io::written(*contents_->find(key)) : "";
}

std::string Settings::unit(const std::string& key) const {
  return has(key) ? contents_->find(key)->row->unit : "";
}

const std::string& Settings::source_text() const { return contents_->source_text; }

}  // namespace riesel::io
