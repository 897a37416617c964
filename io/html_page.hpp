// A self-contained HTML page: style and figures are in it, nothing is fetched, nothing is executed.
#pragma once

#include "io/svg.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace riesel::io {

/// Near the beginning of each page, before the version of riesel: tells it from files of others.
inline constexpr std::string_view mark_of_pages = R"(<meta name="generator" content="riesel )";

/// A cell of a table.
struct HtmlCell {
  HtmlCell(std::string content, std::string address = "")  // NOLINT(google-explicit-constructor)
      : text(std::move(content)), link(std::move(address)) {}
  HtmlCell(const char* content) : text(content) {}  // NOLINT(google-explicit-constructor)

  std::string text;
  std::string link;  ///< relative to the page; empty: none
};

using HtmlRows = std::vector<std::vector<HtmlCell>>;

/// Parts appear in the order in which they are added. All texts are escaped.
class HtmlPage {
public:
  explicit HtmlPage(std::string_view title);

  void heading(std::string_view text);
  /// `name` is a CSS class, "good", "doubtful" or "bad", or empty.
  void paragraph(std::string_view text, std::string_view name = "");
  void list(const std::vector<std::string>& items);
  /// The first row is the head; all rows have the same length. Columns of numbers are set to the
  /// right.
  void table(const HtmlRows& rows);
  void figure(const Svg& svg, std::string_view caption);
  /// Verbatim text, folded away under its name.
  void folded(std::string_view name, std::string_view text);

  /// The whole page.
  std::string text() const;

private:
  void add(std::string_view element, std::string_view text, std::string_view name = "");

  std::string title_, body_;
};

}  // namespace riesel::io
