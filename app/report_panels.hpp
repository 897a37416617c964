// Which of many curves share a figure.
//
// A curve is distinguished from the others by its marks: a stiffness, a branch, a width. A figure
// has no more curves than a reader can tell apart; more are divided among figures by their first
// marks, in the order of the sweep file. Marks that all curves of a figure share are in its title,
// the others in its legend.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace riesel::app {

struct Mark {
  std::string name;   ///< of a setting; empty for a branch
  std::string value;  ///< with its unit

  bool operator==(const Mark&) const = default;
};

struct Panel {
  std::string title;                ///< empty if its curves share no mark
  std::vector<std::size_t> curves;  ///< indices into `marks_of_curves`
  std::vector<std::string> names;   ///< of each of these curves; "" if it is alone
};

/// All curves have marks of the same names in the same order; no two have the same values for all.
std::vector<Panel> panels_of(const std::vector<std::vector<Mark>>& marks_of_curves);

}  // namespace riesel::app
