#include "io/html_page.hpp"

#include "io/markup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace riesel::io {
namespace {

constexpr std::string_view style = R"(
body { max-width: 62em; margin: 2em auto; padding: 0 1em; font: 16px/1.5 sans-serif; color: #222;
       background: #fff; }
h1 { font-size: 1.6em; } h2 { font-size: 1.2em; margin-top: 2em; border-bottom: 1px solid #ccc; }
svg { max-width: 100%; height: auto; } figure { margin: 1em 0; }
figcaption { color: #555; font-size: 0.9em; max-width: 50em; }
table { border-collapse: collapse; } th, td { padding: 0.2em 0.8em; text-align: left;
       border-bottom: 1px solid #ddd; vertical-align: top; overflow-wrap: anywhere; }
th.number, td.number { text-align: right; white-space: nowrap; }
.good, .doubtful, .bad { padding: 0.4em 0.8em; border-left: 0.4em solid; }
.good { border-color: #2e7d32; } .doubtful { border-color: #e6a100; } .bad { border-color: #c62828; }
pre { background: #f5f5f5; padding: 0.8em; overflow-x: auto; font-size: 0.85em; }
summary { cursor: pointer; }
)";

using Rows = std::vector<std::vector<std::string>>;

bool is_number(std::string_view cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789+-.e %") == std::string_view::npos;
}

/// Below the head.
bool has_numbers_only(const Rows& rows, std::size_t column) {
  return rows.size() > 1 && std::all_of(rows.begin() + 1, rows.end(), [&](const auto& row) {
           return is_number(row.at(column));
         });
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

void HtmlPage::table(const std::vector<std::vector<std::string>>& rows) {
  body_ += "<table>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string_view element = i == 0 ? "th" : "td";
    body_ += "<tr>";
    for (std::size_t column = 0; column < rows[i].size(); ++column)
      body_ += fmt::format("<{}{}>{}</{}>", element,
                           has_numbers_only(rows, column) ? " class=\"number\"" : "",
                           escaped(rows[i][column]), element);
    body_ += "</tr>\n";
  }
  body_ += "</table>\n";
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
                     "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
                     escaped(title_), style, body_);
}

}  // namespace riesel::io
