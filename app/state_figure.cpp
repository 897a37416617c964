#include "app/state_figure.hpp"

#include "io/colour_scale.hpp"
#include "io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace riesel::app {

namespace {

using io::Point;

constexpr double most_width = 960.0, most_height = 640.0, gap = 18.0;  // px
constexpr double room_below = 64.0;                                    // px, for the colour bar
constexpr double largest_grain = 40.0, smallest_grain = 5.0;           // px, diameter
constexpr double most_grains = 20000.0;                                // a page of a few MB
constexpr std::size_t most_columns = 24;
constexpr double thickest = 6.0, thinnest = 0.5, unknown_thickness = 1.5;  // px, of contacts

/// The distance (m) by which bodies can reach out of the box.
double margin_of(const io::FinalState& state) {
  double margin = 0.0;
  for (const Grain& grain : state.grains) margin = std::max(margin, grain.radius);
  for (const WallLattice& wall : state.walls) margin = std::max(margin, wall.extent());
  return margin;
}

/// Where things are drawn: the tube is cut into columns of equal length.
class Layout {
public:
  explicit Layout(const io::FinalState& state)
      : tube_length_(state.box.length),
        margin_(margin_of(state)),
        outer_width_(state.box.width + 2.0 * margin_) {
    const double diameter = state.mean_diameter();
    show_all(diameter);
    if (scale_ * diameter < smallest_grain) show_a_part(smallest_grain / diameter);
    const double density = static_cast<double>(state.grains.size()) / tube_length_;
    column_length_ = std::min(column_length_, most_grains / (density * number_of_columns()));
  }

  std::size_t columns() const { return columns_; }
  double scale() const { return scale_; }  ///< px/m
  bool is_whole() const { return length_shown() > (1.0 - 1e-9) * tube_length_; }
  double column_length() const { return column_length_; }                       ///< m
  double length_shown() const { return number_of_columns() * column_length_; }  ///< m
  double width() const {
    return number_of_columns() * (outer_width_ * scale_ + gap) - gap;
  }                                                                            ///< px
  double height() const { return (column_length_ + 2.0 * margin_) * scale_; }  ///< px

  /// The column of a body with this y (m, in the box); nothing if it is not shown.
  std::optional<std::size_t> column_of(double y) const {
    const auto column = static_cast<std::size_t>(std::max(y, 0.0) / column_length_);
    if (column < columns_) return column;
    return is_whole() ? std::optional(columns_ - 1) : std::nullopt;
  }

  Point place(std::size_t column, double x, double y) const {
    const auto index = static_cast<double>(column);
    return {index * (outer_width_ * scale_ + gap) + (x + margin_) * scale_,
            (y - index * column_length_ + margin_) * scale_};
  }

private:
  double number_of_columns() const { return static_cast<double>(columns_); }

  /// Chooses the number of columns for which grains are drawn largest.
  void show_all(double diameter) {
    for (std::size_t n = 1; n <= most_columns; ++n) {
      const auto columns = static_cast<double>(n);
      const double across = (most_width - (columns - 1.0) * gap) / (columns * outer_width_);
      const double along = most_height / (tube_length_ / columns + 2.0 * margin_);
      const double scale = std::min({across, along, largest_grain / diameter});
      if (scale <= scale_) continue;
      scale_ = scale;
      columns_ = n;
      column_length_ = tube_length_ / columns;
    }
  }

  /// Shows part of the tube at a scale (px/m) at which grains can be seen, if its width allows it.
  void show_a_part(double wanted_scale) {
    scale_ = std::min(wanted_scale, most_width / outer_width_);
    const double fitting = (most_width + gap) / (outer_width_ * scale_ + gap);
    columns_ = static_cast<std::size_t>(std::max(1.0, std::floor(fitting)));
    const double height = most_height / scale_;
    column_length_ = std::min(std::max(height - 2.0 * margin_, 0.5 * height),
                              tube_length_ / number_of_columns());
  }

  double tube_length_, margin_, outer_width_;  // m
  double scale_ = 0.0;
  std::size_t columns_ = 1;
  double column_length_ = 0.0;  // m
};

/// Without the slowest and the fastest hundredth, which would leave few colours for all others.
io::Interval velocity_range(const io::FinalState& state) {
  std::vector<double> velocities;
  for (const Grain& grain : state.grains) velocities.push_back(grain.vy);
  std::sort(velocities.begin(), velocities.end());
  const auto at = [&](double part) {
    return velocities[static_cast<std::size_t>(part * static_cast<double>(velocities.size() - 1))];
  };
  const io::Interval range{at(0.01), at(0.99)};
  const double narrowest = 1e-4 * std::max(std::abs(range.low), std::abs(range.high));
  return range.high - range.low > narrowest ? range : io::range_of(velocities);
}

class Drawing {
public:
  explicit Drawing(const io::FinalState& state)
      : state_(&state),
        layout_(state),
        velocities_(velocity_range(state)),
        largest_force_(largest_force_drawn()),
        svg_(std::max(layout_.width(), 420.0), layout_.height() + room_below,
             fmt::format("The grains at t = {:.6g} s, coloured by their axial velocity",
                         state.time)) {
    draw_walls();
    draw_grains();
    draw_contacts();
    draw_colour_bar();
  }

  StateFigure figure() && {
    return {.svg = std::move(svg_),
            .columns = layout_.columns(),
            .length_shown = std::min(layout_.length_shown(), state_->box.length),
            .grains_drawn = grains_drawn_,
            .largest_force = largest_force_};
  }

private:
  void draw_walls() {
    svg_.begin_group("walls", {.fill = "#9a9a9a"});
    for (const WallLattice& wall : state_->walls) {
      const WallWay way = wall.motion.way(state_->box, state_->time);
      if (wall.smooth()) draw_plane(wall.line + way.x);
      for (std::int64_t k = 0; k < wall.count; ++k) {
        const auto [x, y] = wall.place(k, way, state_->box);
        const auto column = layout_.column_of(y);
        if (!column) continue;
        svg_.disc(layout_.place(*column, x, y), wall.radius * layout_.scale());
      }
    }
    svg_.end_group();
  }

  /// A smooth wall at x (m).
  void draw_plane(double x) {
    for (std::size_t column = 0; column < layout_.columns(); ++column) {
      const double top = static_cast<double>(column) * layout_.column_length();
      svg_.line(layout_.place(column, x, top),
                layout_.place(column, x, top + layout_.column_length()),
                {.stroke = "#9a9a9a", .stroke_width = 2.0});
    }
  }

  void draw_grains() {
    svg_.begin_group("grains", {.stroke = "#222222", .stroke_width = 0.3});
    for (const Grain& grain : state_->grains) {
      const auto column = layout_.column_of(grain.y);
      if (!column) continue;
      ++grains_drawn_;
      const double place = (grain.vy - velocities_.low) / (velocities_.high - velocities_.low);
      svg_.disc(layout_.place(*column, grain.x, grain.y), grain.radius * layout_.scale(),
                {.fill = io::colour(place)});
    }
    svg_.end_group();
  }

  /// From centre to centre.
  void draw_contacts() {
    svg_.begin_group("contacts", {.stroke = "#d01c1c"});
    for (std::size_t i = 0; i < state_->contacts.size(); ++i) {
      const ContactName& name = state_->contacts[i];
      const Grain& grain = first_body(name);
      const auto column = layout_.column_of(grain.y);
      if (!column) continue;
      const auto [x, y] = place_of_partner(name);
      const double along = std::remainder(y - grain.y, state_->box.length);
      svg_.line(layout_.place(*column, grain.x, grain.y),
                layout_.place(*column, x, grain.y + along), {.stroke_width = thickness(i)});
    }
    svg_.end_group();
  }

  /// N; 0 if there is none that is finite.
  double largest_force_drawn() const {
    double largest = 0.0;
    for (std::size_t i = 0; i < state_->forces.size(); ++i) {
      const bool is_drawn = layout_.column_of(first_body(state_->contacts[i]).y).has_value();
      if (is_drawn && std::isfinite(state_->forces[i]))
        largest = std::max(largest, state_->forces[i]);
    }
    return largest;
  }

  /// px, of a contact, proportional to its force.
  double thickness(std::size_t contact) const {
    if (state_->forces.empty()) return unknown_thickness;
    const double force = state_->forces[contact];
    if (!std::isfinite(force)) return thickest;
    return largest_force_ > 0.0 ? std::max(thinnest, thickest * (force / largest_force_))
                                : thinnest;
  }

  const Grain& first_body(const ContactName& name) const {
    return state_->grains[static_cast<std::size_t>(name.grain)];
  }

  /// m
  Point place_of_partner(const ContactName& name) const {
    if (name.wall == no_wall) {
      const Grain& partner = state_->grains[static_cast<std::size_t>(name.partner)];
      return {partner.x, partner.y};
    }
    const WallLattice& wall = state_->walls[static_cast<std::size_t>(name.wall)];
    const WallWay way = wall.motion.way(state_->box, state_->time);
    const double x = wall.line + way.x;
    if (wall.smooth()) return {x, first_body(name).y};
    return {x, static_cast<double>(name.partner) * wall.spacing(state_->box) + way.y};
  }

  void draw_colour_bar() {
    constexpr double left = 10.0, width = 300.0, height = 14.0;
    constexpr int steps = 60;
    const double top = layout_.height() + 14.0;
    svg_.begin_group("colour_bar");
    for (int i = 0; i < steps; ++i) {  // each extends below the next, so that no seam is visible
      const double part = static_cast<double>(i) / steps;
      svg_.rectangle({left + part * width, top}, (1.0 - part) * width, height,
                     {.fill = io::colour((i + 0.5) / steps)});
    }
    for (const double value : io::ticks(velocities_, 6)) {
      const double part = (value - velocities_.low) / (velocities_.high - velocities_.low);
      const double x = left + part * width;
      svg_.line({x, top + height}, {x, top + height + 4.0}, {.stroke = "#333333"});
      svg_.text({x, top + height + 17.0}, fmt::format("{:.6g}", value), {.anchor = "middle"});
    }
    svg_.text({left + width + 14.0, top + 12.0}, "v_y (m/s)");
    svg_.end_group();
  }

  const io::FinalState* state_;
  Layout layout_;
  io::Interval velocities_;
  double largest_force_;  // N
  io::Svg svg_;
  std::size_t grains_drawn_ = 0;
};

}  // namespace

StateFigure draw_state(const io::FinalState& state) { return Drawing(state).figure(); }

}  // namespace riesel::app
