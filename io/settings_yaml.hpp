// From YAML text to a tree in which every key and value knows its place.
//
// The tree is built from the parser's events and not from yaml-cpp's own nodes, because those hide
// what a settings file must be refused for: duplicate keys (the first would win), aliases and merge
// keys, tags, several documents. Values are not interpreted here: they stay text until the table of
// settings says what they are, so that nothing is guessed about 017, yes or .nan.
#pragma once

#include "io/settings_error.hpp"

#include <string>
#include <vector>

namespace riesel::io {

struct YamlEntry;

struct YamlNode {
  enum class Shape { null, scalar, list, map };

  Shape shape = Shape::null;
  Place place;
  std::string scalar;              ///< its text
  std::vector<YamlNode> items;     ///< of a list
  std::vector<YamlEntry> entries;  ///< of a map, in the order of the file, no key twice
};

struct YamlEntry {
  std::string key;
  Place key_place;
  YamlNode value;
};

/// The map that a settings file must be. `beginning`: what a user with an empty file is told to
/// begin it with. Throws SettingsError.
YamlNode
parse_settings_yaml(const std::string& text, const std::string& source,
                    const std::string& beginning = "'scenario:' and the name of a scenario");

/// A value given outside a file, such as that of an override; all of its nodes get the same place.
/// Throws SettingsError.
YamlNode parse_yaml_value(const std::string& text, const Place& place);

/// A value that is not written anywhere as such; `place` is where its errors point.
YamlNode scalar_node(const Place& place, std::string text);

/// The entry of a map with this key; nullptr if there is none.
const YamlEntry* find_entry(const YamlNode& map, const std::string& key);

/// How a message names what it found: "'3 kg'", "a list", "a map", "nothing".
std::string describe(const YamlNode& node);

}  // namespace riesel::io
