#include "io/settings_value.hpp"

#include "io/settings_names.hpp"
#include "io/settings_quantity.hpp"
#include "io/settings_yaml.hpp"
#include "io/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>

namespace riesel::io {
namespace {

const std::string& read_scalar(const Setting& row, const YamlNode& node) {
  if (node.shape != YamlNode::Shape::scalar) refuse_value(row, node, "give a single value");
  return node.scalar;
}

std::int64_t read_integer(const Setting& row, const YamlNode& node) {
  const auto& text = read_scalar(row, node);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) refuse_value(row, node, "it must fit into 64 bits");
  if (error != std::errc{} || end != text.data() + text.size()) {
    refuse_value(row, node, "write its decimal digits and nothing else");
  }
  if (std::to_string(value) != text) refuse_value(row, node, fmt::format("write {}", value));
  check_range(row, node, static_cast<double>(value));
  return value;
}

SettingValue read_integer_or_auto(const Setting& row, const YamlNode& node) {
  if (read_scalar(row, node) == "auto") return Auto{};
  return read_integer(row, node);
}

std::string read_choice(const Setting& row, const YamlNode& node) {
  const auto& text = read_scalar(row, node);
  if (std::ranges::find(row.choices, text) != row.choices.end()) return text;
  refuse_value(row, node, did_you_mean(text, row.choices).value_or("choose one of them"));
}

std::string read_text(const Setting& row, const YamlNode& node) {
  const auto& text = read_scalar(row, node);
  if (text.empty()) refuse_value(row, node, "give a text");
  return text;
}

/// Absolute, so that the recorded settings mean the same wherever they are moved. A path that is
/// not written in a file is relative to the working directory.
std::string read_path(const Setting& row, const YamlNode& node) {
  namespace fs = std::filesystem;
  const bool from_file = node.place.line > 0;
  const auto home = from_file ? fs::path(node.place.source).parent_path() : fs::path();
  std::string path = fs::absolute(home / read_text(row, node)).lexically_normal().string();
  if (!is_utf8(path))  // nor would the files that record it be
    refuse_value(row, node, "its whole path, " + path + ", is not UTF-8: rename that directory");
  return path;
}

}  // namespace

std::string expectation(const Setting& row) {
  switch (row.kind) {
  case Kind::number:
    return expected_quantity(row);
  case Kind::integer:
    return "an integer";
  case Kind::choice:
    return enumerate(row.choices);
  case Kind::text:
    return "a text";
  case Kind::path:
    return "the path of a file or directory";
  case Kind::numbers:
    return expected_quantity(row) + ", or a list of these";
  case Kind::integer_or_auto:
    return "an integer or auto";
  }
  return {};
}

SettingValue read_value(const Setting& row, const YamlNode& node) {
  if (node.shape == YamlNode::Shape::null) {
    throw SettingsError(node.place, row.key, "has no value",
                        fmt::format("give {}, or remove the key", expectation(row)));
  }
  switch (row.kind) {
  case Kind::number:
    return read_quantity(row, node);
  case Kind::integer:
    return read_integer(row, node);
  case Kind::choice:
    return read_choice(row, node);
  case Kind::text:
    return read_text(row, node);
  case Kind::path:
    return read_path(row, node);
  case Kind::numbers:
    return read_quantities(row, node);
  case Kind::integer_or_auto:
    return read_integer_or_auto(row, node);
  }
  return {};
}

void refuse_value(const Setting& row, const YamlNode& node, const std::string& remedy) {
  throw SettingsError(node.place, row.key,
                      fmt::format("expected {}, got {}", expectation(row), describe(node)), remedy);
}

void check_range(const Setting& row, const YamlNode& node, double value) {
  if (row.range.contains(value)) return;
  const bool bare_angle = row.unit == "rad" && !node.scalar.empty()
                          && std::isdigit(static_cast<unsigned char>(node.scalar.back())) != 0;
  throw SettingsError(
      node.place, row.key,
      fmt::format("must be {}, got {}", to_string(row.range, row.unit), describe(node)),
      bare_angle
          ? "a number without a unit is in radians; did you mean '" + node.scalar + " degrees'?"
          : "give a value in this range");
}

}  // namespace riesel::io
