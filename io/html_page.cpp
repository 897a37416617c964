#include "io/html_page.hpp"

#include "io/build_info.hpp"
#include "io/markup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace riesel::io {
namespace {

/// Figures are drawn in dark ink, so they keep a light background in dark mode. What is too wide
/// for the window scrolls by itself.
constexpr std::string_view style = R"(
:root { color-scheme: light dark; --ink: #222; --paper: #fff; --faint: #ddd; --soft: #555;
        --inset: #f5f5f5; --link: #1a5fb4; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e4e4; --paper: #1b1d20; --faint: #44484d; --soft: #b0b4b8; --inset: #272a2e;
          --link: #8ab8f0; }
}
body { max-width: 66em; margin: 2em auto; padding: 0 1em; font: 16px/1.5 sans-serif;
       color: var(--ink); background: var(--paper); }
h1 { font-size: 1.6em; }
h2 { font-size: 1.2em; margin-top: 2em; border-bottom: 1px solid var(--faint); }
a { color: var(--link); }
figure { margin: 1em 0; overflow-x: auto; }
svg { max-width: 100%; height: auto; background: #fff; border-radius: 4px; }
@media (max-width: 40em) { svg { max-width: none; width: 40em; } }
figcaption { color: var(--soft); font-size: 0.9em; max-width: 50em; }
.table { overflow-x: auto; font-size: 0.9em; }
table { border-collapse: collapse; }
th, td { padding: 0.2em 0.7em; text-align: left; border-bottom: 1px solid var(--faint);
         vertical-align: top; }
th { vertical-align: bottom; }
.number { text-align: right; }
td.number, td.short { white-space: nowrap; }
td.long { overflow-wrap: anywhere; min-width: 16em; }
.good, .doubtful, .bad { padding: 0.4em 0.8em; border-left: 0.4em solid; }
.good { border-color: #2e7d32; } .doubtful { border-color: #e6a100; } .bad { border-color: #c62828; }
pre { background: var(--inset); padding: 0.8em; overflow-x: auto; font-size: 0.85em; }
summary { cursor: pointer; }
)";

bool is_number(std::string_view cell) {
  return cell.find_first_not_of("0123456789+-.e %") == std::string_view::npos;
}

/// Whether it fits on one line.
bool is_short(std::string_view cell) { return cell.size() <= 40; }

/// The class of the cells of a column, see the style. A cell is empty where nothing is known.
std::string_view class_of(const HtmlRows& rows, std::size_t column) {
  const auto all = [&](auto holds) {
    return std::all_of(rows.begin() + 1, rows.end(),
                       [&](const auto& row) { return holds(row.at(column).text); });
  };
  if (rows.size() > 1 && all(is_number)) return "number";
  return all(is_short) ? "short" : "long";
}

std::string markup_of(const HtmlCell& cell) {
  if (cell.link.empty()) return escaped(cell.text);
  return fmt::format("<a href=\"{}\">{}</a>", escaped(cell.link), escaped(cell.text));
}

}  // namespace

HtmlPage::HtmlPage(std::string_view title) : title_(title) { add("h1", title); }

void HtmlPage::add(std::string_view element, std::string_view text, std::string_view name) {
  const auto of_class = name.empty() ? "" : fmt::format(" class=\"{}\"", escaped(name));
  body_ += fmt::format("<{}{}>{}</{}>\n", element, of_class, escaped(text), element);
}

void HtmlPage::heading(std::string_view text) { add("h2", text); }

void HtmlPage::paragraph(std::string_view text, std::string_view name) { add("p", text, name); }

void HtmlPage::list(const std::vector<std::string>& items) {
  body_ += "<ul>\n";
  for (const auto& item : items) add("li", item);
  body_ += "</ul>\n";
}

void HtmlPage::table(const HtmlRows& rows) {
  std::vector<std::string_view> classes;
  for (std::size_t column = 0; column < rows.front().size(); ++column)
    classes.push_back(class_of(rows, column));
  body_ += "<div class=\"table\">\n<table>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string_view element = i == 0 ? "th" : "td";
    body_ += "<tr>";
    for (std::size_t column = 0; column < rows[i].size(); ++column)
      body_ += fmt::format("<{} class=\"{}\">{}</{}>", element, classes.at(column),
                           markup_of(rows[i][column]), element);
    body_ += "</tr>\n";
  }
  body_ += "</table>\n</div>\n";
}

void HtmlPage::figure(const Svg& svg, std::string_view caption) {
  body_ += "<figure>\n" + svg.element();
  add("figcaption", caption);
  body_ += "</figure>\n";
}

void HtmlPage::folded(std::string_view name, std::string_view text) {
  body_ += "<details>\n";
  add("summary", name);
  add("pre", text);
  body_ += "</details>\n";
}

std::string HtmlPage::text() const {
  return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                     "<meta name=\"viewport\" content=\"width=device-width\">\n"
                     "<meta name=\"generator\" content=\"{}\">\n"
                     "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
                     written_by(), escaped(title_), style, body_);
}

}  // namespace riesel::io
