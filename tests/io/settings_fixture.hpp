// Two scenarios with every kind of setting, and a way to catch what reading a text throws.
#pragma once

#include "io/settings.hpp"
#include "tests/catch.hpp"
#include "tests/message_of.hpp"

#include <string>
#include <vector>

namespace settings_fixture {

using namespace riesel::io;
using riesel::message_of;

inline SettingsTable with_common(const SettingsTable& rows) {
  auto table = common_settings();
  table.insert(table.end(), rows.begin(), rows.end());
  return table;
}

inline const SettingsTables& tables() {
  static const Setting diameter = {.key = "grains.diameter",
                                   .unit = "m",
                                   .fallback = "1 mm",
                                   .range = positive(),
                                   .doc = "Diameter of the grains."};
  static const SettingsTables all = {
      {"tube",
       with_common({diameter,
                    {.key = "grains.polydispersity",
                     .unit = "1",
                     .fallback = "5 %",
                     .range = {.low = 0.0, .high = 1.0, .high_open = true},
                     .doc = "Relative half width of the distribution of radii."},
                    {.key = "tube.width", .unit = "m", .required = true, .doc = "Width."},
                    {.key = "gravity", .unit = "m/s^2", .fallback = "10 m/s^2", .doc = "Gravity."},
                    {.key = "output.title", .kind = Kind::text, .doc = "Title."},
                    {.key = "output.pictures",
                     .kind = Kind::choice,
                     .fallback = "some",
                     .choices = {"some", "none"},
                     .doc = "Whether to draw."}})},
      {"wall", with_common({diameter,
                            {.key = "impact.speed",
                             .kind = Kind::numbers,
                             .unit = "m/s",
                             .fallback = "[0.1, 0.3 m/s]",
                             .range = non_negative(),
                             .doc = "Speeds."},
                            {.key = "impact.starts",
                             .kind = Kind::integer,
                             .fallback = "10",
                             .range = between(1, 1000),
                             .doc = "Starting points."}})},
  };
  return all;
}

inline Settings read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return Settings::from_text(text, "f.yaml", tables(), overrides);
}

/// The whole message; empty if there was none.
inline std::string error(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return message_of<SettingsError>([&] { (void)read(text, overrides); });
}

/// The error of one line within an otherwise complete tube; the line's number is 4.
inline std::string tube_error(const std::string& line) {
  return error("scenario: tube\ntube: {width: 20 mm}\ncontact: {stiffness: 2000}\n" + line + "\n");
}

/// The same for a wall and the section of the impact: the value begins in column 17.
inline std::string speed_error(const std::string& value) {
  return error("scenario: wall\ncontact: {stiffness: 2000}\nimpact: {speed: " + value + "}\n");
}

}  // namespace settings_fixture
