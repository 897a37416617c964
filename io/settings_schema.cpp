#include "io/settings_schema.hpp"

#include "io/json_file.hpp"
#include "io/settings_quantity.hpp"
#include "io/sweep_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace riesel::io {
namespace {

// --- values ---

Json in_range(const char* type, const Range& range) {
  Json schema = {{"type", type}};
  if (std::isfinite(range.low)) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high))
    schema[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
  return schema;
}

/// A number, or a text with a unit. The range applies to numbers; of a text only the sign is
/// checked.
Json quantity(const Setting& row) {
  const std::string pattern = quantity_pattern(row.unit, row.range.low < 0.0);
  return {{"anyOf", {in_range("number", row.range), {{"type", "string"}, {"pattern", pattern}}}}};
}

Json span_of(const Setting& row) {
  return {{"type", "object"},
          {"properties",
           {{"from", quantity(row)},
            {"to", quantity(row)},
            {"points", in_range("integer", between(2, most_values))},
            {"spacing", {{"enum", {"log", "linear"}}}}}},
          {"required", {"from", "to", "points", "spacing"}},
          {"additionalProperties", false}};
}

Json list_of(const Json& items) { return {{"type", "array"}, {"items", items}, {"minItems", 1}}; }

/// Of the values of one setting.
Json short_list_of(const Json& items) {
  Json list = list_of(items);
  list["maxItems"] = most_values;
  return list;
}

Json value_of(const Setting& row) {
  switch (row.kind) {
  case Kind::number:
    return quantity(row);
  case Kind::numbers:
    return {{"anyOf", {quantity(row), short_list_of(quantity(row)), span_of(row)}}};
  case Kind::integer:
    return in_range("integer", row.range);
  case Kind::integer_or_auto:
    return {{"anyOf", {in_range("integer", row.range), {{"const", "auto"}}}}};
  case Kind::choice:
    return {{"enum", row.choices}};
  case Kind::text:
  case Kind::path:
    return {{"type", "string"}, {"minLength", 1}};
  }
  return true;
}

Json described(const Setting& row) {
  Json schema = value_of(row);
  std::string text = row.doc;
  if (!row.unit.empty() && row.unit != "1") text += fmt::format(" Unit: {}.", row.unit);
  if (row.only_when) text += fmt::format(" Only when {}.", to_string(*row.only_when));
  schema["description"] = text;
  if (!row.fallback.empty()) {
    const Json parsed = Json::parse(row.fallback, nullptr, false);
    schema["default"] = parsed.is_number() ? parsed : Json(row.fallback);
  }
  return schema;
}

// --- a scenario ---

/// A file whose setting `key` fits `schema`: wraps the schema in the sections that lead to the key.
Json around(const std::string& key, const Json& schema, bool required) {
  Json inner = {{"properties", {{name_in_section(key), schema}}}};
  if (required) inner["required"] = {name_in_section(key)};
  const std::string section = section_of(key);
  return section.empty() ? inner : around(section, inner, required);
}

/// The file meets `when`, and the setting that it refers to applies; one that is not given has its
/// default.
Json condition(const When& when, const SettingsTable& table) {
  const auto row = std::ranges::find(table, when.key, &Setting::key);
  const bool by_default = std::ranges::find(when.values, row->fallback) != when.values.end();
  Json own = around(when.key, {{"enum", when.values}}, !by_default);
  if (!row->only_when) return own;
  return {{"allOf", Json::array({own, condition(*row->only_when, table)})}};
}

/// The names in a section, or at the top level of a file, with the values that they may have under
/// any conditions.
Json section(const SettingsTable& table, const std::string& path) {
  Json properties = Json::object();
  for (const std::string& part : names_of(table, path)) {
    const std::string key = key_of(path, part);
    if (has_section(table, key)) {
      properties[part] = section(table, key);
      continue;
    }
    std::vector<Json> values;
    for (const Setting& row : table)
      if (row.key == key) values.push_back(described(row));
    properties[part] = values.size() == 1 ? values.front() : Json{{"anyOf", values}};
  }
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

/// Keys with conditions: where none of these is met, the key is a mistake.
Json conditions(const SettingsTable& table) {
  Json all = Json::array();
  std::set<std::string> conditional;
  for (const Setting& row : table) {
    if (!row.only_when) {
      if (row.required) all.push_back(around(row.key, true, true));
      continue;
    }
    all.push_back({{"if", condition(*row.only_when, table)},
                   {"then", around(row.key, described(row), row.required)}});
    conditional.insert(row.key);
  }
  for (const std::string& key : conditional)
    all.push_back({{"if", condition(condition_of(table, key).value(), table)},
                   {"then", true},
                   {"else", around(key, false, false)}});
  return all;
}

Json scenario_schema(const SettingsTable& table) {
  Json schema = section(table, "");
  schema["allOf"] = conditions(table);
  return schema;
}

Json head(const char* title) {
  return {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
}

/// Of a settings file. Refers to /definitions for the schema of each scenario.
Json file_schema(const SettingsTables& tables) {
  Json choices = Json::array();
  for (const auto& [name, table] : tables)
    choices.push_back({{"if", around("scenario", {{"const", name}}, true)},
                       {"then", {{"$ref", "#/definitions/" + name}}}});
  return {{"type", "object"},
          {"properties",
           {{"scenario",
             {{"enum", names_of_scenarios(tables)}, {"description", "The scenario to run."}}}}},
          {"required", {"scenario"}},
          {"allOf", choices}};
}

/// The schema of each scenario, which `of` makes of its table.
template <class Of>
Json definitions(const SettingsTables& tables, Of of) {
  Json all = Json::object();
  for (const auto& [name, table] : tables) all[name] = of(table);
  return all;
}

// --- sweeps ---

/// For each dotted key, what `of` makes of the rows that it has in any scenario.
template <class Of>
Json overrides(const SettingsTables& tables, Of of) {
  std::map<std::string, std::vector<Json>> by_key;
  for (const auto& [name, table] : tables)
    for (const Setting& row : table) {
      auto& values = by_key[row.key];
      const Json value = of(row);
      if (row.key != "scenario" && std::ranges::find(values, value) == values.end())
        values.push_back(value);
    }
  Json properties = Json::object();
  for (const auto& [key, values] : by_key)
    if (!values.empty()) properties[key] = {{"anyOf", values}};
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

Json nothing() { return {{"type", "null"}}; }

Json value_or_nothing(const Setting& row) { return {{"anyOf", {value_of(row), nothing()}}}; }

/// For set and branches, which may take out whole sections, too.
Json changes(const SettingsTables& tables) {
  Json all = overrides(tables, value_or_nothing);
  for (const auto& [name, table] : tables)
    for (const Setting& row : table)
      for (std::string section = section_of(row.key); !section.empty();
           section = section_of(section))
        all["properties"][section] = nothing();
  return all;
}

Json values_along(const Setting& row) {
  const Json list = list_of(value_or_nothing(row));
  return row.kind == Kind::number ? Json{{"anyOf", {list, span_of(row)}}} : list;
}

Json axis_schema(const SettingsTables& tables) {
  Json axis = overrides(tables, values_along);
  axis["minProperties"] = 1;
  return axis;
}

Json seeds_schema(const SettingsTables& tables) {
  const SettingsTable& any = tables.begin()->second;
  const Setting& seed = *std::ranges::find(any, "seed", &Setting::key);
  return {{"anyOf", {in_range("integer", between(1, most_seeds)), list_of(value_of(seed))}},
          {"description", "A list of seeds, or how many: 3 stands for 1, 2 and 3."}};
}

}  // namespace

std::string settings_schema(const SettingsTables& tables) {
  Json schema = head("Settings of riesel");
  schema.update(file_schema(tables));
  schema["definitions"] = definitions(tables, scenario_schema);
  return schema.dump(1) + "\n";
}

std::string sweep_schema(const SettingsTables& tables) {
  Json schema = head("A sweep of riesel");
  // What the base lacks, set, axes and branches may give: whether it is complete is not asked.
  Json all = definitions(tables, [](const SettingsTable& table) { return section(table, ""); });
  all["settings"] = file_schema(tables);
  all["overrides"] = changes(tables);
  all["axis"] = axis_schema(tables);
  const Json axis = {{"$ref", "#/definitions/axis"}};
  const Json set = {{"$ref", "#/definitions/overrides"}};
  schema.update(Json{
      {"type", "object"},
      {"properties",
       {{"base",
         {{"anyOf", {{{"type", "string"}, {"minLength", 1}}, {{"$ref", "#/definitions/settings"}}}},
          {"description", "A settings file, relative to this one, or settings."}}},
        {"set", {{"allOf", {set}}, {"description", "Settings that differ from the base."}}},
        {"axes",
         {{"anyOf", {axis, list_of(axis)}},
          {"description",
           "Settings that vary, each with its values; those in one list item vary together."}}},
        {"seeds", seeds_schema(tables)},
        {"branches",
         {{"type", "object"},
          {"minProperties", 1},
          {"propertyNames", {{"minLength", 1}}},
          {"additionalProperties", set},
          {"description", "Named sets of overrides."}}},
        {"continue_along",
         {{"type", "string"},
          {"description", "The axis along which each run starts where its neighbour ended."}}}}},
      {"required", {"base"}},
      {"additionalProperties", false}});
  schema["definitions"] = all;
  return schema.dump(1) + "\n";
}

}  // namespace riesel::io
