#include "engine/tube_profiles.hpp"

#include "engine/time_series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace riesel {

namespace {

constexpr Estimate not_known{unknown, unknown};

/// One of the sums that a quantity is made of, and the derivative of the quantity with respect to
/// the mean of this sum.
struct LinearTerm {
  StripSum sum;
  double derivative;
  std::optional<std::size_t> strip = std::nullopt;  // none: the sum over all strips of the zone
};

/// The blocks of one zone.
class ZoneBlocks {
public:
  ZoneBlocks(const TimeBlocks& blocks, const Strips& strips, const Zone& zone, std::int64_t first)
      : blocks_(blocks),
        width_(strips.width),
        zone_(zone),
        first_(first),
        size_(means(StripSum::grains).size()) {}

  std::size_t size() const { return size_; }
  double width_of_strip() const { return width_; }  ///< m
  const Zone& strips() const { return zone_; }

  double mean(StripSum sum) const { return mean_of(means(sum)); }
  double mean(StripSum sum, std::size_t strip) const { return mean_of(means(sum, strip)); }
  /// How many grains in all samples together.
  double seen(std::size_t strip) const {
    const auto samples =
        static_cast<double>(size_) * static_cast<double>(blocks_.samples_per_block());
    return samples * mean(StripSum::grains, strip);
  }

  /// The sum of the terms.
  double sum(std::span<const LinearTerm> terms) const {
    double total = 0.0;
    for (const LinearTerm& term : terms)
      total += term.derivative * (term.strip ? mean(term.sum, *term.strip) : mean(term.sum));
    return total;
  }
  double error(std::span<const LinearTerm> terms) const {
    return mean_with_error(linear(terms)).error;
  }
  /// A mean over the grains of the zone; its error is that of its linear part, which `terms`
  /// describe. Not known if nothing has varied, as when all rows caught one grain in one flight.
  Estimate mean_over_grains(double value, std::span<const LinearTerm> terms) const {
    const double error = error_per_weight(linear(terms), means(StripSum::grains));
    const bool constant = error <= 1e-12 * std::abs(value);  // but for rounding
    return {value, constant ? unknown : error};
  }

private:
  std::vector<double> linear(std::span<const LinearTerm> terms) const {
    std::vector<double> total(size_, 0.0);
    for (const LinearTerm& term : terms) {
      const std::vector<double> of_blocks =
          term.strip ? means(term.sum, *term.strip) : means(term.sum);
      for (std::size_t i = 0; i < size_; ++i) total[i] += term.derivative * of_blocks[i];
    }
    return total;
  }
  double mean_of(const std::vector<double>& of_blocks) const {
    return std::accumulate(of_blocks.begin(), of_blocks.end(), 0.0) / static_cast<double>(size_);
  }
  std::vector<double> means(StripSum sum, std::size_t strip) const {
    return blocks_.means(Strips::column(strip, sum), first_);
  }
  std::vector<double> means(StripSum sum) const {
    std::vector<double> total;
    for (const std::size_t strip : zone_) {
      const std::vector<double> of_strip = means(sum, strip);
      total.resize(of_strip.size());
      std::transform(total.begin(), total.end(), of_strip.begin(), total.begin(), std::plus<>());
    }
    return total;
  }

  const TimeBlocks& blocks_;
  double width_;
  const Zone& zone_;
  std::int64_t first_;
  std::size_t size_;
};

/// The sum of the terms over the area of the zone (m^2).
Estimate density(const ZoneBlocks& b, double area, std::vector<LinearTerm> terms) {
  const double value = b.sum(terms) / area;
  for (LinearTerm& term : terms) term.derivative /= area;
  return {value, b.error(terms)};
}
Estimate density(const ZoneBlocks& b, double area, StripSum sum) {
  return density(b, area, {{sum, 1.0}});
}

/// A stress (N/m) of contacts, as it is. If no row has caught any, nothing tells how they scatter.
Estimate known_by_contacts(const ZoneBlocks& b, const Estimate& stress) {
  const bool none = b.mean(StripSum::contact_xx) == 0.0 && b.mean(StripSum::contact_yy) == 0.0;
  return {stress.value, none ? unknown : stress.error};
}

Estimate contact_stress(const ZoneBlocks& b, double area, StripSum contact) {
  return known_by_contacts(b, density(b, area, contact));
}

Estimate stress(const ZoneBlocks& b, double area, StripSum kinetic, StripSum contact) {
  return known_by_contacts(b, density(b, area, {{kinetic, 1.0}, {contact, 1.0}}));
}

/// The sum of the terms over the number of grains in the zone.
Estimate per_grain(const ZoneBlocks& b, std::vector<LinearTerm> terms) {
  const double grains = b.mean(StripSum::grains);
  if (grains == 0.0) return not_known;
  const double mean = b.sum(terms) / grains;
  terms.push_back({StripSum::grains, -mean});
  for (LinearTerm& term : terms) term.derivative /= grains;
  return b.mean_over_grains(mean, terms);
}
Estimate per_grain(const ZoneBlocks& b, StripSum sum) { return per_grain(b, {{sum, 1.0}}); }

/// Which sums are those of weights alone, times w and so on.
struct Moments {
  StripSum one, w, w2, z, z2, zw;
};
constexpr Moments of_grains{StripSum::grains, StripSum::w,  StripSum::w2,
                            StripSum::z,      StripSum::z2, StripSum::zw};
constexpr Moments of_mass{StripSum::mass,   StripSum::mass_w,  StripSum::mass_w2,
                          StripSum::mass_z, StripSum::mass_z2, StripSum::mass_zw};

/// The profile of the velocity within a strip: w = at_middle + slope z.
struct Line {
  double at_middle = 0.0, slope = 0.0;
};

/// So few grains seen, or places of so little variance (in squared widths of a strip), have no
/// line.
constexpr double few = 20.0, one_place = 1e-9;

/// The line of least squares. Level where few grains were seen, or all in one place.
Line line_through(const ZoneBlocks& b, const Moments& moments, std::size_t strip) {
  const double weight = b.mean(moments.one, strip);
  if (weight == 0.0) return {};
  const double z = b.mean(moments.z, strip) / weight, w = b.mean(moments.w, strip) / weight;
  const double zz = b.mean(moments.z2, strip) / weight - z * z;
  const bool has_slope = b.seen(strip) > few && zz > one_place;
  const double slope = has_slope ? (b.mean(moments.zw, strip) / weight - z * w) / zz : 0.0;
  return {.at_middle = w - slope * z, .slope = slope};
}

/// The weighted sum of the squares of w about the line in each strip. As this sum is least for that
/// line, it may be taken as given in the derivatives.
std::vector<LinearTerm> random_part(const ZoneBlocks& b, const Moments& moments) {
  std::vector<LinearTerm> terms;
  for (const std::size_t strip : b.strips()) {
    const auto [w, slope] = line_through(b, moments, strip);
    terms.insert(terms.end(), {{moments.w2, 1.0, strip},
                               {moments.w, -2.0 * w, strip},
                               {moments.zw, -2.0 * slope, strip},
                               {moments.one, w * w, strip},
                               {moments.z, 2.0 * w * slope, strip},
                               {moments.z2, slope * slope, strip}});
  }
  return terms;
}

/// 1/s, the slope of w across the zone: of the line of least squares through all its grains. Not
/// known where few grains were seen, or all in one place.
Estimate shear_rate(const ZoneBlocks& b) {
  // X counts widths of a strip from the middle of strip 0. Means over the blocks:
  double n = 0.0, sum_x = 0.0, sum_x2 = 0.0, sum_w = 0.0, sum_xw = 0.0, seen = 0.0;
  for (const std::size_t strip : b.strips()) {
    const auto i = static_cast<double>(strip);
    const double of_n = b.mean(StripSum::grains, strip), z = b.mean(StripSum::z, strip),
                 w = b.mean(StripSum::w, strip);
    seen += b.seen(strip);
    n += of_n;
    sum_w += w;
    sum_x += i * of_n + z;
    sum_x2 += i * i * of_n + 2.0 * i * z + b.mean(StripSum::z2, strip);
    sum_xw += i * w + b.mean(StripSum::zw, strip);
  }
  if (seen <= few) return not_known;
  const double x = sum_x / n, spread = sum_x2 - x * sum_x;
  if (spread <= one_place * n) return not_known;
  const double slope = (sum_xw - x * sum_w) / spread, at_0 = sum_w / n - slope * x;
  // A grain moves the slope by (X - x)(w - at_0 - slope X) / spread.
  std::vector<LinearTerm> terms;
  for (const std::size_t strip : b.strips()) {
    const double i = static_cast<double>(strip) - x;
    const double to_line = at_0 + slope * static_cast<double>(strip);
    terms.insert(terms.end(), {{StripSum::zw, 1.0, strip},
                               {StripSum::w, i, strip},
                               {StripSum::z2, -slope, strip},
                               {StripSum::z, -to_line - slope * i, strip},
                               {StripSum::grains, -i * to_line, strip}});
  }
  for (LinearTerm& term : terms) term.derivative /= spread * b.width_of_strip();
  return b.mean_over_grains(slope / b.width_of_strip(), terms);
}

/// Mean over the grains of the squares of w about the line in their strip.
Estimate variance_of_w(const ZoneBlocks& b) { return per_grain(b, random_part(b, of_grains)); }

/// Mean over the grains of (I / m) (spin - W)^2, where W is the mean spin of the strip, weighted
/// with I / m. As the sum is least for this W, it may be taken as given in the derivatives.
Estimate rotational_temperature(const ZoneBlocks& b) {
  std::vector<LinearTerm> terms;
  for (const std::size_t strip : b.strips()) {
    const double weight = b.mean(StripSum::gyration2, strip);
    const double mean = weight > 0.0 ? b.mean(StripSum::gyration2_spin, strip) / weight : 0.0;
    terms.insert(terms.end(), {{StripSum::gyration2_spin2, 1.0, strip},
                               {StripSum::gyration2_spin, -2.0 * mean, strip},
                               {StripSum::gyration2, mean * mean, strip}});
  }
  return per_grain(b, std::move(terms));
}

Estimate kinetic_stress_yy(const ZoneBlocks& b, double area) {
  return density(b, area, random_part(b, of_mass));
}

Estimate stress_yy(const ZoneBlocks& b, double area) {
  std::vector<LinearTerm> terms = random_part(b, of_mass);
  terms.push_back({StripSum::contact_yy, 1.0});
  return known_by_contacts(b, density(b, area, std::move(terms)));
}

/// What is known of spins: where grains do not rotate, that they are 0.
Estimate of_spins(const ZoneBlocks& b, Estimate (*of)(const ZoneBlocks&)) {
  const bool none_rotates = b.mean(StripSum::grains) > 0.0 && b.mean(StripSum::gyration2) == 0.0;
  return none_rotates ? Estimate{0.0, 0.0} : of(b);
}

struct Quantity {
  std::string_view name, unit, meaning;
  Estimate (*of)(const ZoneBlocks&, double area);
};

using B = ZoneBlocks;
using S = StripSum;

constexpr std::array<Quantity, 19> quantities = {{
    {"area_fraction", "1", "Part of the area that grains cover.",
     [](const B& b, double a) { return density(b, a, S::area); }},
    {"density", "kg/m^2", "Mass per area, of the grains with their centre in the strip.",
     [](const B& b, double a) { return density(b, a, S::mass); }},
    {"mean_axial_velocity", "m/s", "Mean axial velocity of the grains, positive downstream.",
     [](const B& b, double) { return per_grain(b, S::vy); }},
    {"shear_rate", "1/s", "Slope of the mean axial velocity, d v_y / dx.",
     [](const B& b, double) { return shear_rate(b); }},
    {"temperature_x", "m^2/s^2",
     "Mean square of v_x of the grains about the mean of all at that moment.",
     [](const B& b, double) { return per_grain(b, S::u2); }},
    {"temperature_y", "m^2/s^2",
     "Variance of v_y of the grains, less the mean of all at that moment, about a straight line "
     "across their strip.",
     [](const B& b, double) { return variance_of_w(b); }},
    {"mean_spin", "rad/s",
     "Mean spin of the grains, positive from x towards y; 0 where they do not rotate.",
     [](const B& b, double) { return of_spins(b, [](auto& z) { return per_grain(z, S::spin); }); }},
    {"rotational_temperature", "m^2/s^2",
     "Mean of I (w - W)^2 / m over the grains, W the mean spin in their strip, weighted with I / "
     "m.",
     [](const B& b, double) { return of_spins(b, rotational_temperature); }},
    {"stress_xx", "N/m", "Normal stress across the tube, positive in compression.",
     [](const B& b, double a) { return stress(b, a, S::mass_vx2, S::contact_xx); }},
    {"stress_xy", "N/m", "Shear stress: momentum along y that goes to larger x.",
     [](const B& b, double a) { return stress(b, a, S::mass_vx_w, S::contact_xy); }},
    {"stress_yx", "N/m", "Shear stress: momentum along x that goes to larger y.",
     [](const B& b, double a) { return stress(b, a, S::mass_vx_w, S::contact_yx); }},
    {"stress_yy", "N/m", "Normal stress along the tube, positive in compression.", stress_yy},
    {"kinetic_stress_xx", "N/m", "The part of stress_xx that grains carry in flight.",
     [](const B& b, double a) { return density(b, a, S::mass_vx2); }},
    {"kinetic_stress_xy", "N/m", "The part of stress_xy, and of stress_yx, of grains in flight.",
     [](const B& b, double a) { return density(b, a, S::mass_vx_w); }},
    {"kinetic_stress_yy", "N/m", "The part of stress_yy that grains carry in flight.",
     kinetic_stress_yy},
    {"contact_stress_xx", "N/m", "The part of stress_xx that contacts carry.",
     [](const B& b, double a) { return contact_stress(b, a, S::contact_xx); }},
    {"contact_stress_xy", "N/m", "The part of stress_xy that contacts carry.",
     [](const B& b, double a) { return contact_stress(b, a, S::contact_xy); }},
    {"contact_stress_yx", "N/m", "The part of stress_yx that contacts carry.",
     [](const B& b, double a) { return contact_stress(b, a, S::contact_yx); }},
    {"contact_stress_yy", "N/m", "The part of stress_yy that contacts carry.",
     [](const B& b, double a) { return contact_stress(b, a, S::contact_yy); }},
}};

}  // namespace

std::vector<Zone> each_strip(const Strips& strips) {
  std::vector<Zone> zones(strips.count);
  for (std::size_t strip = 0; strip < strips.count; ++strip) zones[strip] = {strip};
  return zones;
}

Zone core_of(const Strips& strips) {
  const std::size_t left_out = (strips.count + 1) / 4;  // on either side
  Zone zone(strips.count - 2 * left_out);
  std::iota(zone.begin(), zone.end(), left_out);
  return zone;
}

Zone wall_layers_of(const Strips& strips, std::size_t walls) {
  return strips.count > 1 && walls > 1 ? Zone{0, strips.count - 1} : Zone{0};
}

std::vector<TubeProfile> tube_profiles(const TimeBlocks& blocks, const Strips& strips,
                                       const std::vector<Zone>& zones, std::int64_t first) {
  std::vector<TubeProfile> profiles;
  for (const Quantity& q : quantities) {
    TubeProfile profile{.name = q.name, .unit = q.unit, .meaning = q.meaning, .zones = {}};
    for (const Zone& zone : zones) {
      const ZoneBlocks of_zone(blocks, strips, zone, first);
      const double area = strips.area() * static_cast<double>(zone.size());
      profile.zones.push_back(of_zone.size() > 0 ? q.of(of_zone, area) : not_known);
    }
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace riesel
