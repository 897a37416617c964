#include "app/report_panels.hpp"

#include "io/plot.hpp"

#include <algorithm>
#include <numeric>

namespace riesel::app {

namespace {

using Curves = std::vector<std::vector<Mark>>;
using Indices = std::vector<std::size_t>;

bool all_share(const Curves& curves, const Indices& chosen, std::size_t mark) {
  return std::ranges::all_of(
      chosen, [&](std::size_t i) { return curves[i][mark] == curves[chosen.front()][mark]; });
}

void add(const Mark& mark, std::string& text) {
  if (!text.empty()) text += ", ";
  if (!mark.name.empty()) text += mark.name + " ";
  text += mark.value;
}

Panel panel_of(const Curves& curves, const Indices& chosen) {
  Panel panel{.title = "", .curves = chosen, .names = std::vector<std::string>(chosen.size())};
  for (std::size_t mark = 0; mark < curves[chosen.front()].size(); ++mark) {
    if (all_share(curves, chosen, mark)) {
      add(curves[chosen.front()][mark], panel.title);
      continue;
    }
    for (std::size_t i = 0; i < chosen.size(); ++i) add(curves[chosen[i]][mark], panel.names[i]);
  }
  return panel;
}

/// Adds panels for the chosen curves, which are divided by the marks from `first` on.
void part(const Curves& curves, const Indices& chosen, std::size_t first,
          std::vector<Panel>& panels) {
  if (chosen.size() <= io::different_looks || first == curves[chosen.front()].size()) {
    panels.push_back(panel_of(curves, chosen));
    return;
  }
  Indices rest = chosen;
  while (!rest.empty()) {
    const Mark mark = curves[rest.front()][first];
    const auto others = std::stable_partition(
        rest.begin(), rest.end(), [&](std::size_t i) { return curves[i][first] == mark; });
    part(curves, {rest.begin(), others}, first + 1, panels);
    rest.erase(rest.begin(), others);
  }
}

}  // namespace

std::vector<Panel> panels_of(const std::vector<std::vector<Mark>>& marks_of_curves) {
  std::vector<Panel> panels;
  if (marks_of_curves.empty()) return panels;
  Indices all(marks_of_curves.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  part(marks_of_curves, all, 0, panels);
  return panels;
}

}  // namespace riesel::app
