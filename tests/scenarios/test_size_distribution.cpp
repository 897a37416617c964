// Sizes of grains: their moments against closed forms, the same for the same seed, and what is
// refused.
#include "scenarios/size_distribution.hpp"

#include "scenarios/flow_start.hpp"
#include "tests/io/file_fixture.hpp"
#include "tests/scenarios/scenario_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <vector>

using namespace scenario_fixture;
using file_fixture::ScratchDirectory;
using scenarios::SizeDistribution;

namespace {

constexpr std::uint64_t many = 200'000;
constexpr double mean = 1e-3;  // m, the default of grains.diameter

std::vector<double> draw(const Overrides& overrides, std::uint64_t count = many) {
  const SizeDistribution sizes(read(tube_yaml, overrides));
  std::vector<double> diameters(count);
  for (std::uint64_t i = 0; i < count; ++i) diameters[i] = sizes.diameter(i);
  return diameters;
}

/// Mean of (d / mean - 1)^power.
double central_moment(const std::vector<double>& diameters, int power) {
  double sum = 0.0;
  for (const double d : diameters) sum += std::pow(d / mean - 1.0, power);
  return sum / static_cast<double>(diameters.size());
}

/// Checks the moments 1 to 4 about the mean; each within five of its standard errors, which follow
/// from the moment of twice the power.
void check_moments(const std::vector<double>& diameters, const std::vector<double>& expected) {
  for (int power = 1; power <= 4; ++power) {
    const double error = std::sqrt(central_moment(diameters, 2 * power) / many);
    CAPTURE(power, expected[static_cast<std::size_t>(power - 1)]);
    CHECK(std::abs(central_moment(diameters, power) - expected[static_cast<std::size_t>(power - 1)])
          < 5.0 * error);
  }
}

class FileOfSizes {
public:
  explicit FileOfSizes(const std::string& text) : path_(directory_ / "sizes.csv") {
    std::ofstream(path_) << text;
  }
  Overrides overrides() const {
    return {"grains.size_distribution=file", "grains.sizes_from=" + path_.string()};
  }

private:
  ScratchDirectory directory_;
  std::filesystem::path path_;
};

}  // namespace

TEST_CASE("uniform sizes have the moments of a uniform distribution") {
  const double s = 0.2;
  check_moments(draw({"grains.polydispersity=0.2"}), {0.0, s * s / 3.0, 0.0, s * s * s * s / 5.0});
}

TEST_CASE("truncated normal sizes have the moments of one cut off at three deviations") {
  // phi and the probability within three deviations; by parts, the second and fourth moments.
  const double s = 0.1;
  const double phi = std::exp(-4.5) / std::sqrt(2.0 * std::numbers::pi);
  const double within = std::erf(3.0 / std::numbers::sqrt2);
  const double second = 1.0 - 6.0 * phi / within;
  const double fourth = 3.0 * second - 54.0 * phi / within;
  check_moments(draw({"grains.size_distribution=truncated_normal", "grains.polydispersity=0.1"}),
                {0.0, s * s * second, 0.0, s * s * s * s * fourth});
}

TEST_CASE("two sizes have the mean set, the ratio set and the moments of two values") {
  const double q = 5.0, f = 0.1, small = 1.0 / (1.0 + f * (q - 1.0));
  const auto diameters = draw(
      {"grains.size_distribution=bidisperse", "grains.size_ratio=5", "grains.large_fraction=0.1"});
  const auto [least, most] = std::minmax_element(diameters.begin(), diameters.end());
  CHECK(std::abs(*most / *least / q - 1.0) < 1e-14);
  std::vector<double> expected;
  for (int power = 1; power <= 4; ++power)
    expected.push_back((1.0 - f) * std::pow(small - 1.0, power)
                       + f * std::pow(q * small - 1.0, power));
  CHECK(std::abs(expected[0]) < 1e-15);
  check_moments(diameters, expected);
}

TEST_CASE("sizes from a file are those of the file, each as often") {
  const FileOfSizes file("# sieved\ndiameter (mm)\n0.5\n1\n\n1\n1.5\n");
  const auto diameters = draw(file.overrides());
  for (const double value : {0.5e-3, 1e-3, 1.5e-3}) {
    const auto count = static_cast<double>(std::ranges::count(diameters, value));
    const double part = value == 1e-3 ? 0.5 : 0.25;
    CAPTURE(value);
    CHECK(std::abs(count / many - part) < 5.0 * std::sqrt(part * (1.0 - part) / many));
  }
  CHECK(SizeDistribution(read(tube_yaml, file.overrides())).largest() == 1.5e-3);
}

TEST_CASE("the same seed gives the same sizes to the last bit, another seed others") {
  const FileOfSizes file("diameter (mm)\n0.5\n1\n1.3\n1.5\n");
  const std::vector<Overrides> kinds = {
      {},
      {"grains.size_distribution=truncated_normal"},
      {"grains.size_distribution=bidisperse", "grains.size_ratio=3"},
      file.overrides()};
  for (Overrides kind : kinds) {
    const auto first = draw(kind, 1000);
    CHECK(draw(kind, 1000) == first);
    kind.emplace_back("seed=2");
    CHECK(draw(kind, 1000) != first);
  }
}

TEST_CASE("no size is larger than the largest") {
  const Overrides kind =
      GENERATE(Overrides{"grains.polydispersity=0.3"},
               Overrides{"grains.size_distribution=truncated_normal"},
               Overrides{"grains.size_distribution=bidisperse", "grains.size_ratio=3"});
  const auto diameters = draw(kind);
  const double largest = SizeDistribution(read(tube_yaml, kind)).largest();
  CHECK(*std::ranges::max_element(diameters) <= largest);
  CHECK(*std::ranges::max_element(diameters) > 0.9 * largest);
}

TEST_CASE("mean and mean square are those of what is drawn") {
  const FileOfSizes file("diameter (mm)\n0.4\n0.5\n0.6\n");
  const std::vector<Overrides> kinds = {
      {"grains.polydispersity=0.3"},
      {"grains.size_distribution=truncated_normal", "grains.polydispersity=0.3"},
      {"grains.size_distribution=bidisperse", "grains.size_ratio=3", "grains.large_fraction=0.2"},
      file.overrides()};
  for (const Overrides& kind : kinds) {
    CAPTURE(kind);
    double sum = 0.0, squares = 0.0;
    for (const double d : draw(kind)) {
      sum += d;
      squares += d * d;
    }
    const SizeDistribution sizes(read(tube_yaml, kind));
    // The standard error is 0.3 % of the squares.
    CHECK(std::abs(sum / many / sizes.mean() - 1.0) < 0.01);
    CHECK(std::abs(squares / many / sizes.mean_square() - 1.0) < 0.01);
  }
}

TEST_CASE("more grains than can be counted are refused before they are made") {
  const std::vector<std::string> told = {"would be needed to cover 0.00022 m^2, more than 1e+09",
                                         "choose larger grains"};
  const auto check_refused = [&](const Overrides& overrides, const std::string& expected) {
    const std::string message = complaint(tube_yaml, overrides);
    check_mentions(message, told);
    check_mentions(message, {expected});
  };
  check_refused({"grains.diameter=0.5 um"}, "grains.diameter: about 1.12e+09 grains of 5e-07 m");
  check_refused({"grains.diameter=1 nm"}, "grains.diameter: about 2.8e+14 grains");
  check_refused({"grains.diameter=1e-200"}, "grains.diameter: about ");
  check_refused(FileOfSizes("diameter (mm)\n1e-6\n").overrides(),
                "grains.sizes_from: about 2.8e+14 grains");
}

TEST_CASE("as many grains as fit into the memory of a large machine are not too many") {
  const io::Settings settings = read(tube_yaml, {"grains.polydispersity=0"});
  const double area = 0.25 * std::numbers::pi * mean * mean;
  constexpr double count = 1e7;
  const auto radii = scenarios::radii_of_area(settings, SizeDistribution(settings), count * area);
  CHECK(std::abs(static_cast<double>(radii.size()) - count) <= 1.0);
}

TEST_CASE("masses go as the areas for grains of two sizes too") {
  const State state = tube({"grains.size_distribution=bidisperse", "grains.size_ratio=3",
                            "grains.large_fraction=0.2", "grains.mass=2 mg"})
                          .state;
  std::vector<double> masses(state.grains.mass.begin(), state.grains.mass.end());
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const double relative = 2.0 * state.grains.radius[i] / mean;
    CHECK(std::abs(masses[i] / (2e-6 * relative * relative) - 1.0) < 1e-12);
  }
  const auto [lightest, heaviest] = std::ranges::minmax(masses);
  CHECK(std::abs(heaviest / lightest - 9.0) < 1e-9);
}

TEST_CASE("settings that a distribution does not have are refused, and so are useless files") {
  check_mentions(complaint(tube_yaml, {"grains.size_distribution=bidisperse"}),
                 {"grains.size_ratio: is missing"});
  check_mentions(
      complaint(tube_yaml, {"grains.size_distribution=bidisperse", "grains.size_ratio=2",
                            "grains.polydispersity=0.1"}),
      {"grains.polydispersity: has no effect when grains.size_distribution is bidisperse"});
  check_mentions(
      complaint(tube_yaml, {"grains.size_distribution=file", "grains.sizes_from=nowhere.csv"}),
      {"grains.sizes_from: cannot be read", "nowhere.csv"});
  check_mentions(complaint(tube_yaml, FileOfSizes("diameter (mm)\n1\n-1\n").overrides()),
                 {"sizes.csv:3:1: diameter: is not above 0"});
  check_mentions(complaint(tube_yaml, FileOfSizes("diameter\n0.9\n1.1\n").overrides()),
                 {"grains.sizes_from: the periodic tube is too short", "as in 'diameter (mm)'"});
  check_mentions(complaint(tube_yaml, FileOfSizes("diameter (mm)\n").overrides()),
                 {"sizes.csv: has no rows"});
}
