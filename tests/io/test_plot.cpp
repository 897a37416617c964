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

Plot small_plot() { return {200.0, 100.0, "a plot", {"t (s)", {0.0, 2.0}}, {"v", {-1.0, 1.0}}}; }

}  // namespace

TEST_CASE("Ticks are round numbers within the range") {
  CHECK(ticks({0.0, 1.0}, 6) == std::vector{0.0, 0.2, 2 * 0.2, 3 * 0.2, 4 * 0.2, 1.0});
  CHECK(ticks({-1.0, 1.0}, 3) == std::vector{-1.0, 0.0, 1.0});
  CHECK(ticks({3.0, 47.0}, 5) == std::vector{10.0, 20.0, 30.0, 40.0});
  CHECK(ticks({1499.0, 1501.0}, 4) == std::vector{1499.0, 1500.0, 1501.0});
  CHECK_FALSE(std::signbit(ticks({-0.5, 0.5}, 3).at(1)));
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

TEST_CASE("Marks stay within the axes") {
  auto plot = small_plot();
  const auto before = plot.svg().element();
  plot.level({0.0, 2.0}, 1.5, {.stroke = "red"});
  plot.moment(-0.1, "before", {.stroke = "red"});
  CHECK(plot.svg().element() == before);
  plot.area({-5.0, 1.0}, {-9.0, 9.0}, {.fill = "red"});
  const Point corner = plot.at(0.0, 1.0), opposite = plot.at(1.0, -1.0);
  Svg expected(200.0, 100.0, "a rectangle");
  expected.rectangle(corner, opposite.x - corner.x, opposite.y - corner.y, {.fill = "red"});
  const auto text = expected.element();
  const auto begin = text.find("<rect");
  CHECK(count_of(plot.svg().element(), text.substr(begin, text.find("/>") - begin)) == 1);
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
