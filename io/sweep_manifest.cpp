#include "io/sweep_manifest.hpp"

#include "io/build_info.hpp"
#include "io/file_error.hpp"
#include "io/json_cell.hpp"
#include "io/json_file.hpp"
#include "io/settings_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace riesel::io {
namespace {

namespace fs = std::filesystem;

static_assert(2 * largest_plan <= largest_json);

constexpr int format_version = 1;
constexpr auto format_name = "riesel sweep";

Json to_json(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return nullptr;
}

Json to_json(const ManifestPoint& point, const std::vector<VariedSetting>& varied) {
  Json settings = Json::object();
  for (std::size_t i = 0; i < varied.size(); ++i) {
    settings[varied[i].key] = to_json(point.values[i]);
  }
  Json json = {{"name", point.name},
               {"parent", point.parent},
               {"branch", point.branch},
               {"leg", point.leg},
               {"settings", settings},
               {"expected_seconds", point.expected_seconds},
               {"most_threads", point.most_threads},
               {"status", point.status},
               {"attempts", point.attempts},
               {"reason", point.reason}};
  if (!point.inputs.empty()) json["inputs"] = point.inputs;
  return json;
}

/// A point's name is that of its directory, so it must not lead anywhere else.
void require_name_of_point(const std::string& name) {
  const auto is_hex_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (name.size() != 16 || !std::ranges::all_of(name, is_hex_digit))
    throw std::runtime_error("a point has the name " + quoted(name));
}

ManifestPoint point_of(const Json& json, const std::vector<VariedSetting>& varied) {
  ManifestPoint point = {.name = json.at("name"),
                         .parent = json.at("parent"),
                         .branch = json.at("branch"),
                         .leg = json.at("leg"),
                         .values = {},
                         .expected_seconds = json.at("expected_seconds"),
                         .most_threads = integer_of<int>(json.at("most_threads")),
                         .status = json.at("status"),
                         .attempts = integer_of<int>(json.at("attempts")),
                         .reason = json.at("reason")};
  if (json.contains("inputs"))
    point.inputs = json.at("inputs").get<std::map<std::string, std::string>>();
  for (const auto& setting : varied) {
    point.values.push_back(cell_of(json.at("settings").at(setting.key)));
  }
  require_name_of_point(point.name);
  if (!point.parent.empty()) require_name_of_point(point.parent);
  return point;
}

Manifest manifest_of(const Json& json) {
  if (json.at("format") != format_name || json.at("format_version") != format_version) {
    throw std::runtime_error("it has another format");
  }
  Manifest manifest;
  for (const auto& setting : json.at("varied")) {
    manifest.varied.push_back({.key = setting.at("key"), .unit = setting.at("unit")});
  }
  for (const auto& point : json.at("points")) {
    manifest.points.push_back(point_of(point, manifest.varied));
  }
  return manifest;
}

/// A list of effective.yaml without its line breaks.
std::string in_one_line(std::string text) {
  for (auto end = text.find('\n'); end != std::string::npos; end = text.find('\n', end))
    text.replace(end, text.find_first_not_of(" \n", end) - end, " ");
  return text;
}

}  // namespace

Cell cell_of(const Settings& settings, const std::string& key) {
  const auto text = settings.written(key);
  if (text.empty()) return {};
  const auto json = Json::parse(text, nullptr, false);
  if (json.is_structured()) return in_one_line(text);
  return json.is_discarded() ? Cell(text) : cell_of(json);
}

std::string to_json(const Manifest& manifest) {
  Json json = {{"format", format_name},
               {"format_version", format_version},
               {"riesel_version", std::string(build_info().version)},
               {"commit", std::string(build_info().git_commit)}};
  json["varied"] = Json::array();
  for (const auto& setting : manifest.varied) {
    json["varied"].push_back({{"key", setting.key}, {"unit", setting.unit}});
  }
  json["points"] = Json::array();
  for (const auto& point : manifest.points) {
    json["points"].push_back(to_json(point, manifest.varied));
  }
  return text_of(json);
}

Manifest read_manifest(const fs::path& directory) {
  const auto path = directory / manifest_name;
  constexpr auto anew =
      "run 'riesel sweep' with its sweep file: it writes a new one and keeps the results";
  const auto json = read_json(
      path, {.unreadable = "give the directory of a sweep (see 'riesel sweep')", .damaged = anew});
  try {
    return manifest_of(json);
  } catch (const std::exception& error) {
    throw FileError(path, fmt::format("is not a manifest of a sweep ({})", flaw_of(error)), anew);
  }
}

}  // namespace riesel::io
