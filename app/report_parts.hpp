// What the reports of runs and of sweeps are made of: a page that collects its figures, and numbers
// as text.
#pragma once

#include "engine/validity.hpp"
#include "io/html_page.hpp"
#include "io/run_reader.hpp"
#include "io/summary.hpp"
#include "io/svg.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace riesel::app {

/// The page, in the directory of its run or sweep.
inline constexpr auto report_name = "report.html";

/// Whether it is a page that riesel has written, and not a file of that name by the user.
bool is_own_report(const std::filesystem::path& page);
/// The same of a figure.
bool is_own_drawing(const std::filesystem::path& file);

/// The figures as files, in the directory of the run or sweep.
inline constexpr auto figures_name = "figures";

/// Removes the drawings of an earlier report from the directory `figures`, if there is one, but for
/// those with the names in `kept`. Files of others stay. Throws std::filesystem::filesystem_error.
void remove_own_drawings(const std::filesystem::path& figures,
                         const std::vector<std::string>& kept);

// How figures look.
inline constexpr double figure_width = 760.0, tall_figure = 420.0;  ///< px
namespace ink {
inline constexpr std::string_view blue = "#26548c", grey = "#777777", red = "#c62828";
}

struct ReportFigure {
  std::string name;  ///< of its file in figures/, without extension
  io::Svg svg;       ///< its links are relative to figures/
};

struct Report {
  std::string page;  ///< HTML that needs no other file
  std::vector<ReportFigure> figures;
};

/// A report being written.
class ReportDraft {
public:
  explicit ReportDraft(std::string_view title) : page_(title) {}

  io::HtmlPage& page() { return page_; }

  /// A figure without links.
  void add_figure(const std::string& name, const io::Svg& svg, std::string_view caption);
  /// A figure with links: for the page, and for its file in figures/, from where they lead up.
  void add_figure(const std::string& name, const io::Svg& in_page, const io::Svg& as_file,
                  std::string_view caption);

  /// Adds the settings, program, machine and command of a run.
  void add_origin(const io::RunSummary& run, const io::RunHistory& history,
                  const std::string& effective_settings);

  Report report() const { return {.page = page_.text(), .figures = figures_}; }

private:
  io::HtmlPage page_;
  std::vector<ReportFigure> figures_;
};

/// The value as text; "not known" for NaN. `form` is a format string for one double.
std::string number(double value, const char* form = "{:.4g}");

/// "spacing (m)"; without a unit if that is empty or "1".
std::string with_unit(const std::string& name, const std::string& unit);

/// The worst verdict on any of `points`, which must not be empty.
template <class Point>
Validity worst_of(const std::vector<Point>& points) {
  return std::ranges::max(points, {}, &Point::verdict).verdict;
}

/// The class of a paragraph about this verdict, see io::HtmlPage.
std::string class_of(Validity validity);

}  // namespace riesel::app
