// Markup: what is written is what was meant, in a drawing and in a page, whatever the texts are.
#include "io/svg.hpp"

#include "io/colour_scale.hpp"
#include "io/html_page.hpp"
#include "io/markup.hpp"
#include "tests/catch.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

using namespace riesel::io;

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Of "#rrggbb", 0 ... 255.
double lightness(const std::string& colour) {
  const auto part = [&](std::size_t i) { return std::stoi(colour.substr(i, 2), nullptr, 16); };
  return 0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5);
}

}  // namespace

TEST_CASE("Text in markup cannot become markup") {
  CHECK(escaped("a < b && c > \"d\" 'e'")
        == "a &lt; b &amp;&amp; c &gt; &quot;d&quot; &#39;e&#39;");
  CHECK(escaped("two\n\tlines, ± and µ") == "two\n\tlines, ± and µ");
  CHECK(escaped("a\xEF\xBF\xBE\xEF\xBF\xBF\xEF\xBF\xBD")
        == "a\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
  CHECK(escaped(std::string("a\0b\x1b", 4))
        == "a\xEF\xBF\xBD"
           "b\xEF\xBF\xBD");
}

TEST_CASE("Shapes of a drawing have their places and styles") {
  Svg svg(200.0, 100.5, "a <drawing>");
  svg.begin_group("dots", {.fill = "red", .stroke_width = 0.5});
  svg.disc({1.0, 2.346}, 3.0);
  svg.end_group();
  svg.line({0.0, -0.001}, {1e3, 10.10}, {.stroke = "#123456", .dashes = "4 3"});
  svg.polyline(std::array<Point, 2>{{{0.5, 1.0}, {2.0, 3.25}}});
  svg.text({5.0, 6.0}, "1 < 2", {.anchor = "end"});
  svg.begin_link("../a b/\"c\"/", "what <it> is");
  svg.polygon(std::array<Point, 3>{{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}}, {.fill = "blue"});
  svg.end_link();
  svg.extend(20.0);
  const auto text = svg.element();
  CHECK(has(text, "<g class=\"dots\" fill=\"red\" stroke-width=\"0.5\">\n"
                  "<circle cx=\"1\" cy=\"2.35\" r=\"3\"/>\n</g>\n"));
  CHECK(has(text, "<line x1=\"0\" y1=\"0\" x2=\"1000\" y2=\"10.1\" stroke=\"#123456\" "
                  "stroke-dasharray=\"4 3\"/>"));
  CHECK(has(text, "<polyline points=\"0.5,1 2,3.25\"/>"));
  CHECK(has(text, "<text x=\"5\" y=\"6\" text-anchor=\"end\">1 &lt; 2</text>"));
  CHECK(has(text, "<title>a &lt;drawing&gt;</title>"));
  CHECK(has(text, "<a href=\"../a b/&quot;c&quot;/\"><title>what &lt;it&gt; is</title>\n"
                  "<polygon points=\"0,0 1,0 0,1\" fill=\"blue\"/>\n</a>\n"));
  CHECK(has(text, "viewBox=\"0 0 200 120.5\""));
  CHECK(text.substr(0, 5) == "<svg ");
}

TEST_CASE("A drawing names its format in a file, and refers to nothing in a page") {
  const Svg svg(10.0, 10.0, "nothing");
  CHECK(has(svg.file(), " xmlns=\"http://www.w3.org/2000/svg\""));
  CHECK(svg.file().substr(0, 6) == "<?xml ");
  CHECK_FALSE(has(svg.element(), "http"));
}

TEST_CASE("A drawing is an image, or a group if there are links in it") {
  Svg svg(10.0, 10.0, "nothing");
  CHECK(has(svg.element(), " role=\"img\""));
  svg.begin_link("there", "a tip");
  svg.end_link();
  CHECK(has(svg.element(), " role=\"group\""));
  CHECK_FALSE(has(svg.element(), "role=\"img\""));
}

TEST_CASE("A drawing takes no coordinate that is not finite") {
  Svg svg(10.0, 10.0, "nothing");
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(svg.disc({1.0, wrong}, 1.0), std::invalid_argument);
}

TEST_CASE("The colour scale grows lighter from end to end and does not go beyond") {
  CHECK(colour(0.0) == "#241c5c");
  CHECK(colour(1.0) == "#fae860");
  CHECK(colour(0.5) == "#228c8c");
  CHECK(colour(-3.0) == colour(0.0));
  CHECK(colour(std::numeric_limits<double>::infinity()) == colour(1.0));
  CHECK(colour(std::nan("")) == "#999999");
  for (int i = 0; i < 50; ++i)
    CHECK(lightness(colour(i / 50.0)) < lightness(colour((i + 1) / 50.0)));
}

TEST_CASE("A page holds its parts in their order, escaped") {
  HtmlPage page("1 < 2");
  page.heading("R&D");
  page.paragraph("<script>", "good");
  page.table({{"name", "J"}, {"a<b", "-1.5e-07"}});
  page.table({{"of both"}, {"1 m/s"}, {"2"}});
  page.table({{"linked"}, {{"3", "points/\"/"}}, {""}});
  page.table({{"words"}, {"many words that need not stand on one line, as others do"}});
  page.figure(Svg(10.0, 10.0, "nothing"), "c > d");
  page.folded("settings", "a: {b: 'c'}\n");
  const auto text = page.text();
  std::size_t last = 0;
  for (const std::string part :
       {"<!DOCTYPE html>", "<title>1 &lt; 2</title>", "<h1>1 &lt; 2</h1>", "<h2>R&amp;D</h2>",
        "<p class=\"good\">&lt;script&gt;</p>",
        "<th class=\"short\">name</th><th class=\"number\">J</th>",
        "<td class=\"short\">a&lt;b</td><td class=\"number\">-1.5e-07</td>",
        "<td class=\"short\">1 m/s</td>", "<td class=\"short\">2</td>",
        "<td class=\"number\"><a href=\"points/&quot;/\">3</a></td>", "<td class=\"number\"></td>",
        "<td class=\"long\">many words", "<svg ", "<figcaption>c &gt; d</figcaption>",
        "<summary>settings</summary>", "<pre>a: {b: &#39;c&#39;}\n</pre>", "</html>"}) {
    const auto found = text.find(part, last);
    INFO(part);
    REQUIRE(found != std::string::npos);
    last = found;
  }
}
