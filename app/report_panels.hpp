// Which of many curves share a figure.
//
// A curve is told from the others by its marks: a stiffness, a branch, a width. As many curves as
// can be told apart share a figure; more of them are parted by their first marks, those that were
// first in the sweep file. Marks that all curves of a figure share stand in its title, the others
// in its legend.
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
  std::string title;                ///< empty if there is nothing to tell
  std::vector<std::size_t> curves;  ///< indices into what was given
  std::vector<std::string> names;   ///< of each of these curves; empty if it is alone
};

/// Every curve has the same marks in the same order; no two curves have equal values for all.
std::vector<Panel> panels_of(const std::vector<std::vector<Mark>>& marks_of_curves);

}  // namespace riesel::app
