// The subcommands of riesel, one file each. They return the exit status, and throw
// io::SettingsError or UnusableInput for bad input, anything else where a run fails.
#pragma once

#include "app/run_directory.hpp"
#include "io/settings.hpp"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace riesel::app {

/// A directory or checkpoint that cannot be used as the user wants.
class UnusableInput : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct RunOptions {
  std::filesystem::path file;                      ///< the settings
  std::optional<std::filesystem::path> directory;  ///< where the results go
  std::vector<std::string> overrides;              ///< "key=value"
};

int run(const RunOptions& options, const Arguments& arguments);

struct ResumeOptions {
  std::filesystem::path checkpoint;    ///< the file, or the directory of the run
  std::vector<std::string> overrides;  ///< "key=value"; only settings of `run` and `output`
};

int resume(const ResumeOptions& options, const Arguments& arguments);

struct CheckOptions {
  std::filesystem::path file;          ///< the settings
  std::vector<std::string> overrides;  ///< "key=value"
};

int check(const CheckOptions& options);

int list_scenarios();

/// The reference page of the settings, in Markdown.
int print_settings();

}  // namespace riesel::app
