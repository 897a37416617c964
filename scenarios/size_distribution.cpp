#include "scenarios/size_distribution.hpp"

#include "io/csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace riesel::scenarios {

namespace {

constexpr double cut_off = 3.0;  // standard deviations of the truncated normal distribution
constexpr double variance_within_cut_off = 0.97334;  // of a standard normal distribution
constexpr auto diameter_key = "grains.diameter", grain_mass_key = "grains.mass",
               file_key = "grains.sizes_from";

std::vector<double> diameters_from_file(const io::Settings& settings) {
  const io::CsvTable table = io::read_csv(settings, file_key, {{.name = "diameter", .unit = "m"}});
  std::vector<double> diameters;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    diameters.push_back(table.value(row, "diameter"));
    if (diameters.back() <= 0.0)
      table.reject(row, "diameter", "is not above 0", "give the diameter of a grain");
  }
  return diameters;
}

}  // namespace

io::SettingsTable size_settings() {
  const io::When spread_out = {"grains.size_distribution", {"uniform", "truncated_normal"}};
  const io::When of_two_sizes = {"grains.size_distribution", {"bidisperse"}};
  return {
      {.key = diameter_key,
       .unit = "m",
       .fallback = "1 mm",
       .range = io::positive(),
       .doc = "Mean diameter of the free grains; of sizes from a file, the diameter that "
              "`grains.mass` is meant for."},
      {.key = grain_mass_key,
       .unit = "kg",
       .fallback = "1 mg",
       .range = io::positive(),
       .doc = "Mass of a free grain of that diameter; others in proportion to their area."},
      {.key = "grains.size_distribution",
       .kind = io::Kind::choice,
       .fallback = "uniform",
       .choices = {"uniform", "truncated_normal", "bidisperse", "file"},
       .doc = "Distribution of the diameters: `uniform`, normal but cut off at three standard "
              "deviations (`truncated_normal`), of two sizes (`bidisperse`), or each drawn from "
              "those in a `file`.",
       .only_when = io::When{"start.kind", {"fresh", "continued"}}},
      {.key = "grains.polydispersity",
       .unit = "1",
       .fallback = "0.05",
       .range = io::between(0.0, 0.3),
       .doc = "Relative spread of the diameters: half width of the uniform distribution, standard "
              "deviation of the truncated normal one.",
       .only_when = spread_out},
      {.key = "grains.size_ratio",
       .unit = "1",
       .required = true,
       .range = io::between(1.0, 20.0),
       .doc = "Diameter of the large grains over that of the small ones.",
       .only_when = of_two_sizes},
      {.key = "grains.large_fraction",
       .unit = "1",
       .fallback = "0.5",
       .range = io::between(0.0, 1.0),
       .doc = "Fraction of grains (by number) that are large; each grain is drawn independently.",
       .only_when = of_two_sizes},
      {.key = file_key,
       .kind = io::Kind::path,
       .required = true,
       .doc = "File of diameters, CSV with the column `diameter (mm)` or another unit "
              "(docs/files.md); each grain draws one of them.",
       .only_when = io::When{"grains.size_distribution", {"file"}},
       .names_content = true},
  };
}

double mass_of_diameter(const io::Settings& settings, double diameter) {
  const double relative = diameter / settings.number(diameter_key);
  return settings.number(grain_mass_key) * relative * relative;
}

SizeDistribution::SizeDistribution(const io::Settings& settings)
    : stream_(static_cast<std::uint64_t>(settings.integer("seed")), Use::radius),
      mean_(settings.number(diameter_key)) {
  const std::string& kind = settings.text("grains.size_distribution");
  if (kind == "file") {
    kind_ = Kind::file;
    of_file_ = diameters_from_file(settings);
    mean_ = std::accumulate(of_file_.begin(), of_file_.end(), 0.0)
            / static_cast<double>(of_file_.size());
  } else if (kind == "bidisperse") {
    kind_ = Kind::bidisperse;
    const double ratio = settings.number("grains.size_ratio");
    large_fraction_ = settings.number("grains.large_fraction");
    small_ = 1.0 / (1.0 + large_fraction_ * (ratio - 1.0));
    large_ = ratio * small_;
  } else {
    kind_ = kind == "uniform" ? Kind::uniform : Kind::truncated_normal;
    spread_ = settings.number("grains.polydispersity");
  }
}

double SizeDistribution::relative_diameter(std::uint64_t grain) const {
  if (kind_ == Kind::uniform) return 1.0 + spread_ * (2.0 * stream_.uniform(grain)[0] - 1.0);
  if (kind_ == Kind::bidisperse)
    return stream_.uniform(grain)[0] < large_fraction_ ? large_ : small_;
  for (std::uint32_t draw = 0;; ++draw) {
    const double deviation = stream_.normal(grain, draw)[0];
    if (std::abs(deviation) <= cut_off) return 1.0 + spread_ * deviation;
  }
}

double SizeDistribution::diameter(std::uint64_t grain) const {
  if (kind_ != Kind::file) return mean_ * relative_diameter(grain);
  const double lot = stream_.uniform(grain)[0] * static_cast<double>(of_file_.size());
  return of_file_[std::min(static_cast<std::size_t>(lot), of_file_.size() - 1)];
}

double SizeDistribution::largest() const {
  switch (kind_) {
  case Kind::uniform:
    return mean_ * (1.0 + spread_);
  case Kind::truncated_normal:
    return mean_ * (1.0 + cut_off * spread_);
  case Kind::bidisperse:
    return mean_ * (large_fraction_ > 0.0 ? large_ : small_);
  case Kind::file:
    break;
  }
  return *std::max_element(of_file_.begin(), of_file_.end());
}

double SizeDistribution::mean_square() const {
  switch (kind_) {
  case Kind::uniform:
    return mean_ * mean_ * (1.0 + spread_ * spread_ / 3.0);
  case Kind::truncated_normal:
    return mean_ * mean_ * (1.0 + variance_within_cut_off * spread_ * spread_);
  case Kind::bidisperse:
    return mean_ * mean_ * std::lerp(small_ * small_, large_ * large_, large_fraction_);
  case Kind::file:
    break;
  }
  return std::inner_product(of_file_.begin(), of_file_.end(), of_file_.begin(), 0.0)
         / static_cast<double>(of_file_.size());
}

const char* SizeDistribution::key() const { return kind_ == Kind::file ? file_key : diameter_key; }

}  // namespace riesel::scenarios
