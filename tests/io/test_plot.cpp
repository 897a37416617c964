// Plots: ticks are round and within, curves are where the axes say, and thinning hides no extreme.
#include "io/plot.hpp"

#include "tests/catch.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace riesel::io;

namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

bool contains_all(Interval range, const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [&](double value) { return contains(range, value); });
}

bool close(const std::vector<double>& found, const std::vector<double>& expected) {
  return std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                    [](double a, double b) { return std::abs(a / b - 1.0) < 1e-12; });
}

Plot small_plot() { return {200.0, 100.0, "a plot", {"t (s)", {0.0, 2.0}}, {"v", {-1.0, 1.0}}}; }

}  // namespace

TEST_CASE("Ticks are round numbers within the range") {
  CHECK(ticks({0.0, 1.0}, 6) == std::vector{0.0, 0.2, 2 * 0.2, 3 * 0.2, 4 * 0.2, 1.0});
  CHECK(ticks({-1.0, 1.0}, 3) == std::vector{-1.0, 0.0, 1.0});
  CHECK(ticks({3.0, 47.0}, 5) == std::vector{10.0, 20.0, 30.0, 40.0});
  CHECK(ticks({1499.0, 1501.0}, 4) == std::vector{1499.0, 1500.0, 1501.0});
  CHECK_FALSE(std::signbit(ticks({-0.5, 0.5}, 3).at(1)));
}

TEST_CASE("There are few ticks even where they are the same number") {
  CHECK(ticks({1000.0, std::nextafter(1000.0, 1001.0)}, 6).size() <= 6);
  CHECK(ticks({-3e19, -3e19 + 4096.0}, 6).size() <= 6);
}

TEST_CASE("There are at least one and at most so many ticks, whatever the range") {
  for (int exponent = -12; exponent <= 12; ++exponent)
    for (const double low : {0.0, -0.37, 1.7})
      for (const double width : {1.0, 1.3, 2.6, 7.7, 9.9})
        for (const int most : {2, 6, 9}) {
          const double unit = std::pow(10.0, exponent);
          const Interval range{low * unit, (low + width) * unit};
          const auto found = ticks(range, most);
          INFO(range.low << " ... " << range.high << ", at most " << most);
          REQUIRE(!found.empty());
          REQUIRE(found.size() <= static_cast<std::size_t>(most));
          REQUIRE(std::is_sorted(found.begin(), found.end()));
          REQUIRE(found.front() >= range.low - 1e-9 * width * unit);
          REQUIRE(found.back() <= range.high + 1e-9 * width * unit);
        }
}

TEST_CASE("A range holds all finite values and is never empty") {
  const auto range = range_of(std::vector{3.0, std::nan(""), 1.0, HUGE_VAL, 2.0});
  CHECK(range.low == Approx(0.9));
  CHECK(range.high == Approx(3.1));
  for (const auto& values :
       std::vector<std::vector<double>>{{}, {0.0}, {-4.0, -4.0}, {std::nan("")}})
    CHECK(range_of(values).low < range_of(values).high);
  CHECK(range_of(std::vector{-4.0}).low == Approx(-4.4));
}

TEST_CASE("Values that differ in their last digits have a range whose ticks can be told apart") {
  for (const double value : {1.0, -3.5e-7, 4e12}) {
    const std::vector values = {value, std::nextafter(value, 2.0 * value)};
    const auto range = range_of(values);
    const auto found = ticks(range, 6);
    INFO(value);
    CHECK(found.size() >= 2);
    CHECK(found.size() <= 6);
    CHECK(std::abs(found[1] - found[0]) > 1e-5 * std::abs(value));
    CHECK(contains_all(range, values));
  }
}

TEST_CASE("A scale is logarithmic where positive values spread widely") {
  CHECK(scale_for(std::vector{1.0, 21.0}) == Scale::logarithmic);
  CHECK(scale_for(std::vector{1.0, std::nan(""), 19.0}) == Scale::linear);
  CHECK(scale_for(std::vector{0.0, 100.0}) == Scale::linear);
  CHECK(scale_for(std::vector{-1.0, 100.0}) == Scale::linear);
  CHECK(scale_for(std::vector<double>{}) == Scale::linear);
}

TEST_CASE("A logarithmic range holds all positive values and no other") {
  const std::vector values = {0.01, 1e4};
  const auto range = range_of(values, Scale::logarithmic);
  CHECK(contains_all(range, values));
  CHECK(range.low > 0.003);
  CHECK(range.high < 3e4);
  for (const auto& some : std::vector<std::vector<double>>{{}, {3.0}, {-1.0, 0.0}}) {
    const auto of_few = range_of(some, Scale::logarithmic);
    CHECK(of_few.low > 0.0);
    CHECK(of_few.low < of_few.high);
  }
}

TEST_CASE("A logarithmic axis can show values whose ratio is beyond all numbers") {
  const std::vector<double> values = {1e-300, 0.1, 1e300};
  const Axis axis = with_room_above(axis_for("", values), 0.2);
  REQUIRE(axis.scale == Scale::logarithmic);
  CHECK(std::isfinite(axis.range.low));
  CHECK(std::isfinite(axis.range.high));
  CHECK(part_of(axis, 1e-300) > 0.0);
  CHECK(part_of(axis, 0.1) == Approx(0.47).margin(0.08));
  CHECK(part_of(axis, 1e300) < 1.0);
  CHECK_FALSE(ticks_of(axis, 6).empty());
}

TEST_CASE("Logarithmic ticks are powers of ten, or 1, 2 and 5 times them where there are few") {
  CHECK(close(logarithmic_ticks({0.09, 20.0}), {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0}));
  CHECK(close(logarithmic_ticks({0.05, 2e3}), {0.1, 1.0, 10.0, 100.0, 1e3}));
  CHECK(close(logarithmic_ticks({0.9, 1.9}), {1.0}));
  CHECK(close(logarithmic_ticks({2.2, 2.9}), ticks({2.2, 2.9}, 6)));
  const auto wide = logarithmic_ticks({1e-12, 1e12});
  CHECK(wide.size() >= 5);
  CHECK(wide.size() <= 10);
}

TEST_CASE("A logarithmic axis has equal ratios at equal distances, and no place for zero") {
  const Plot plot(200.0, 100.0, "a plot", {"t", {1.0, 100.0}, Scale::logarithmic},
                  {"v", {0.1, 1000.0}, Scale::logarithmic});
  CHECK(plot.at(10.0, 10.0).x == Approx(0.5 * (plot.at(1.0, 1.0).x + plot.at(100.0, 1.0).x)));
  CHECK(plot.at(10.0, 10.0).y == Approx(0.5 * (plot.at(1.0, 0.1).y + plot.at(1.0, 1e3).y)));
  CHECK_FALSE(std::isfinite(plot.at(10.0, 0.0).y));
  CHECK_FALSE(std::isfinite(plot.at(10.0, -1.0).y));
}

TEST_CASE("A value with its error is a symbol on a bar that stays within the axes") {
  auto plot = small_plot();
  plot.measured(1.0, 0.9, 0.3, look_of(0), true);
  Svg expected(200.0, 100.0, "");
  const Point low = plot.at(1.0, 0.6), high = plot.at(1.0, 1.0);
  expected.line(low, high, {.stroke = look_of(0).colour, .stroke_width = 1.2});
  expected.disc(plot.at(1.0, 0.9), 4.5,
                {.fill = look_of(0).colour, .stroke = look_of(0).colour, .stroke_width = 1.5});
  for (const auto* shape : {"<line", "<circle"}) {
    const auto text = expected.element();
    const auto begin = text.find(shape);
    CHECK(count_of(plot.svg().element(), text.substr(begin, text.find("/>") - begin)) == 1);
  }
}

TEST_CASE("What is not known is not drawn") {
  auto plot = small_plot();
  const auto before = plot.svg().element();
  plot.measured(1.0, std::nan(""), 0.1, look_of(0), true);
  plot.cross(1.0, std::nan(""), look_of(0));
  plot.arrow_up(1.0, std::nan(""), look_of(0));
  CHECK(plot.svg().element() == before);
  plot.measured(1.0, 0.5, std::nan(""), look_of(0), false);
  CHECK(count_of(plot.svg().element(), "<line") == count_of(before, "<line"));
  CHECK(count_of(plot.svg().element(), "<circle") == 1);
}

TEST_CASE("A legend makes room for its entries") {
  auto plot = small_plot();
  plot.legend("both", {{"slow", look_of(0)}, {"fast", look_of(1)}}, true);
  const auto text = plot.svg().element();
  CHECK(count_of(text, ">slow</text>") == 1);
  CHECK(count_of(text, ">both</text>") == 1);
  CHECK(count_of(text, "height=\"158\"") == 1);
  CHECK(look_of(0).colour != look_of(1).colour);
  CHECK(look_of(0).symbol != look_of(1).symbol);
}

TEST_CASE("A plot puts a pair of values where its axes say") {
  const auto plot = small_plot();
  const Point origin = plot.at(0.0, -1.0), opposite = plot.at(2.0, 1.0), centre = plot.at(1.0, 0.0);
  CHECK(origin.x < opposite.x);
  CHECK(origin.y > opposite.y);  // y points down
  CHECK(centre.x == Approx(0.5 * (origin.x + opposite.x)));
  CHECK(centre.y == Approx(0.5 * (origin.y + opposite.y)));
}

TEST_CASE("A curve is interrupted where it is not known") {
  auto plot = small_plot();
  const std::vector<double> x = {0.0, 0.5, 1.0, 1.5, 2.0};
  plot.curve(x, std::vector{0.0, 0.5, std::nan(""), 0.5, 0.0}, {.stroke = "blue"});
  CHECK(count_of(plot.svg().element(), "<polyline") == 2);
}

TEST_CASE("A point of a curve between two gaps is a disc, open where the curve is dashed") {
  auto plot = small_plot();
  const std::vector<double> x = {0.0, 1.0, 2.0}, y = {std::nan(""), 0.5, std::nan("")};
  plot.curve(x, y, {.stroke = "blue"});
  CHECK(count_of(plot.svg().element(), "fill=\"blue\" stroke=\"blue\"") == 1);
  plot.curve(x, y, {.stroke = "red", .dashes = "5 4"});
  CHECK(count_of(plot.svg().element(), "fill=\"#ffffff\" stroke=\"red\"") == 1);
  CHECK(count_of(plot.svg().element(), "<polyline") == 0);
}

TEST_CASE("Marks stay within the axes") {
  auto plot = small_plot();
  const auto before = plot.svg().element();
  plot.level({0.0, 2.0}, 1.5, {.stroke = "red"});
  plot.marker(-0.1, "before", {.stroke = "red"});
  CHECK(plot.svg().element() == before);
  plot.area({-5.0, 1.0}, {-9.0, 9.0}, {.fill = "red"});
  const Point corner = plot.at(0.0, 1.0), opposite = plot.at(1.0, -1.0);
  Svg expected(200.0, 100.0, "a rectangle");
  expected.rectangle(corner, opposite.x - corner.x, opposite.y - corner.y, {.fill = "red"});
  const auto text = expected.element();
  const auto begin = text.find("<rect");
  CHECK(count_of(plot.svg().element(), text.substr(begin, text.find("/>") - begin)) == 1);
}

TEST_CASE("The label of a marker is towards the middle, or in a lower row away from other lines") {
  Plot plot(700.0, 200.0, "a plot", {"t", {0.0, 10.0}}, {"v", {0.0, 1.0}});
  const auto anchor_of = [&](const std::string& label) {
    const auto text = plot.svg().element();
    const auto begin = text.rfind("<text", text.find(">" + label + "</text>"));
    return text.substr(begin, text.find('>', begin) - begin);
  };
  const auto is_on_the_left = [&](const std::string& label) {
    return anchor_of(label).find("text-anchor=\"end\"") != std::string::npos;
  };
  plot.marker(0.5, "no room on the left", {.stroke = "red"}, 3);
  plot.marker(3.0, "smaller", {.stroke = "red"}, 2);
  plot.marker(4.0, "larger", {.stroke = "red"}, 0);
  plot.marker(9.0, "on the right", {.stroke = "red"}, 1);
  CHECK_FALSE(is_on_the_left("no room on the left"));
  CHECK(is_on_the_left("smaller"));
  CHECK_FALSE(is_on_the_left("larger"));
  CHECK(is_on_the_left("on the right"));
}

TEST_CASE("A thinned curve keeps its ends and its extremes in their order") {
  std::vector<Point> points;
  for (int i = 0; i <= 10000; ++i) points.push_back({0.01 * i, std::sin(0.37 * i)});
  points[4321].y = 7.0;
  points[5678].y = -7.0;
  const auto kept = thinned(points, 50);
  CHECK(kept.size() <= std::size_t{4} * 51);
  CHECK(kept.size() >= std::size_t{3} * 50);
  CHECK(kept.front().x == points.front().x);
  CHECK(kept.back().x == points.back().x);
  const auto by_x = [](const Point& a, const Point& b) { return a.x < b.x; };
  const auto by_y = [](const Point& a, const Point& b) { return a.y < b.y; };
  CHECK(std::is_sorted(kept.begin(), kept.end(), by_x));
  CHECK(std::max_element(kept.begin(), kept.end(), by_y)->x == points[4321].x);
  CHECK(std::min_element(kept.begin(), kept.end(), by_y)->x == points[5678].x);
}

TEST_CASE("A short curve is not thinned") {
  const std::vector<Point> points = {{0.0, 1.0}, {1.0, 3.0}, {2.0, 2.0}};
  CHECK(thinned(points, 1).size() == 3);
}
