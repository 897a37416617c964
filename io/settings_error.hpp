// What is wrong with a settings file, said in a way that lets the user put it right: the place, the
// key, the problem and the remedy.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace riesel::io {

/// How the source of an override begins.
inline constexpr std::string_view override_mark = "--set ";

/// Where a setting was written.
struct Place {
  std::string source;  ///< the file, or "--set key=value" for an override
  int line = 0;        ///< 1-based; 0 where lines make no sense
  int column = 0;      ///< 1-based, in characters; 0 where columns make no sense
};

/// "tube.yaml:3:14", or the source alone.
std::string to_string(const Place& place);

/// Bad input. what() is "FILE:LINE:COLUMN: key: problem; remedy", on one line for each error.
class SettingsError : public std::runtime_error {
public:
  /// `key` is the dotted path, or empty if the problem does not concern a key.
  SettingsError(Place place, std::string key, std::string problem, std::string remedy);
  /// The first of several errors, with a what() that covers them all.
  SettingsError(const SettingsError& first, const std::string& what_of_all);

  const Place& place() const { return place_; }
  const std::string& key() const { return key_; }
  const std::string& problem() const { return problem_; }
  const std::string& remedy() const { return remedy_; }

private:
  Place place_;
  std::string key_;
  std::string problem_;
  std::string remedy_;
};

/// The mistakes in one file or command line, which are reported together.
class Mistakes {
public:
  /// Calls read() and keeps a SettingsError that it throws; true if it throws none. When there are
  /// `most_reported`, they are thrown at once, as by throw_if_any().
  template <class Read>
  bool note(Read read) {
    try {
      read();
      return true;
    } catch (const SettingsError& error) {
      all_.push_back(error);
      if (all_.size() == most_reported) throw_if_any();
      return false;
    }
  }

  bool any() const { return !all_.empty(); }
  /// Throws a SettingsError for the first in the file, whose what() has one line for each, and a
  /// last one if there may be more.
  void throw_if_any();

private:
  static constexpr std::size_t most_reported = 20;
  std::vector<SettingsError> all_;
};

/// Text from a settings file as an error message shows it: in quotes, on one line and not too long.
std::string quoted(const std::string& text);

}  // namespace riesel::io
