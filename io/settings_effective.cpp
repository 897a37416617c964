// effective.yaml: every value that a run used, written so that reading it back gives the same bits.
#include "io/settings_contents.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace riesel::io {
namespace {

using Entry = SettingsContents::Entry;

constexpr std::size_t numbers_per_line = 4;

/// The fewest digits that read back to the same double. Always with a point, because readers of
/// YAML 1.1 (such as Python's) take "1e-06" for a text.
std::string written(double value) {
  auto text = fmt::format("{}", value);
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

std::string written(std::int64_t value) { return fmt::format("{}", value); }
std::string written(Auto) { return "auto"; }
/// A text in JSON is one in YAML too, but for one character (DEL).
std::string written(const std::string& text) {
  std::string quoted = nlohmann::json(text).dump();
  for (auto at = quoted.find('\x7f'); at != std::string::npos; at = quoted.find('\x7f', at))
    quoted.replace(at, 1, "\\u007f");
  return quoted;
}

std::string written(const std::vector<double>& values) {
  std::string list = "[";
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) list += i % numbers_per_line == 0 ? ",\n    " : ", ";
    list += written(values[i]);
  }
  return list + "]";
}

std::string line(const Entry& entry) {
  const auto& row = *entry.row;
  const bool has_unit = !row.unit.empty() && row.unit != "1";
  return fmt::format("{}: {}{}\n", name_in_section(row.key), io::written(entry),
                     has_unit ? "  # " + row.unit : "");
}

using Wanted = std::function<bool(const Setting&)>;

/// The lines of the wanted keys of a section; for "", of those at the top level.
std::vector<std::string> lines_of(const SettingsContents& contents, const std::string& section,
                                  const Wanted& wanted) {
  std::vector<std::string> lines;
  for (const auto& entry : contents.entries) {
    const bool belongs = section_of(entry.row->key) == section && wanted(*entry.row);
    if (belongs && entry.value) lines.push_back(line(entry));
  }
  return lines;
}

/// The wanted settings of a section, its subsections last.
std::string text_of(const SettingsContents& contents, const std::string& section,
                    const Wanted& wanted, const std::string& indent) {
  std::string text;
  for (const auto& section_line : lines_of(contents, section, wanted))
    text += indent + section_line;
  for (const auto& name : names_of(*contents.table, section)) {
    const auto inner = text_of(contents, key_of(section, name), wanted, indent + "  ");
    if (!inner.empty()) text += fmt::format("{}{}:\n{}", indent, name, inner);
  }
  return text;
}

}  // namespace

std::string written(const Entry& entry) {
  if (entry.row->kind == Kind::choice) return std::get<std::string>(*entry.value);
  return std::visit([](const auto& value) { return written(value); }, *entry.value);
}

std::string effective_yaml(const SettingsContents& contents, const Wanted& wanted) {
  std::string yaml = "# Every setting of the run, defaults included, in SI units.\n";
  for (const auto& top_line : lines_of(contents, "", wanted)) yaml += top_line;
  for (const auto& section : names_of(*contents.table, "")) {
    const auto text = text_of(contents, section, wanted, "  ");
    if (!text.empty()) yaml += fmt::format("\n{}:\n{}", section, text);
  }
  return yaml;
}

}  // namespace riesel::io
