#include "engine/tube_profiles.hpp"

#include "engine/time_series.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace riesel {

namespace {

constexpr Estimate not_known{unknown, unknown};

/// One of the sums that a quantity depends on: the derivative of the quantity with respect to the
/// mean of this sum.
struct LinearTerm {
  StripSum sum;
  double derivative;
  std::optional<std::size_t> strip = std::nullopt;  // none: the sum over all strips of the zone
};

/// The blocks of one zone.
class ZoneBlocks {
public:
  ZoneBlocks(const TimeBlocks& blocks, const Zone& zone, std::int64_t first)
      : blocks_(blocks), zone_(zone), first_(first), size_(means(StripSum::grains).size()) {}

  std::size_t size() const { return size_; }
  const Zone& strips() const { return zone_; }

  double mean(StripSum sum) const { return mean_of(means(sum)); }
  double mean(StripSum sum, std::size_t strip) const { return mean_of(means(sum, strip)); }

  /// A sum with this value; its error is that of its linear part, which `terms` describe.
  Estimate sum(double value, std::span<const LinearTerm> terms) const {
    return {value, mean_with_error(linear(terms)).error};
  }
  Estimate sum(double value, std::initializer_list<LinearTerm> terms) const {
    return sum(value, std::span(terms));
  }
  /// The same for a mean over the grains of the zone.
  Estimate mean_over_grains(double value, std::span<const LinearTerm> terms) const {
    return {value, error_per_weight(linear(terms), means(StripSum::grains))};
  }
  Estimate mean_over_grains(double value, std::initializer_list<LinearTerm> terms) const {
    return mean_over_grains(value, std::span(terms));
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
  const Zone& zone_;
  std::int64_t first_;
  std::size_t size_;
};

/// The sum `a`, or a + b, over the area of the zone (m^2).
Estimate density(const ZoneBlocks& b, double area, StripSum a) {
  return b.sum(b.mean(a) / area, {{a, 1.0 / area}});
}
Estimate density(const ZoneBlocks& blocks, double area, StripSum a, StripSum b) {
  return blocks.sum((blocks.mean(a) + blocks.mean(b)) / area, {{a, 1.0 / area}, {b, 1.0 / area}});
}

/// Mean over the grains of the zone.
Estimate per_grain(const ZoneBlocks& b, StripSum sum) {
  const double grains = b.mean(StripSum::grains);
  if (grains == 0.0) return not_known;
  const double ratio = b.mean(sum) / grains;
  return b.mean_over_grains(ratio, {{sum, 1.0 / grains}, {StripSum::grains, -ratio / grains}});
}

/// Which sums are those of weights, of weights times w and of weights times w^2.
struct Moments {
  StripSum zeroth, first, second;
};
constexpr Moments of_grains{StripSum::grains, StripSum::w, StripSum::w2};
constexpr Moments of_mass{StripSum::mass, StripSum::mass_w, StripSum::mass_w2};

/// The sum of weights times w^2 minus the part of the mean motion of each strip, and its
/// derivatives.
struct RandomPart {
  double sum = 0.0;
  std::vector<LinearTerm> terms;
};

RandomPart random_part(const ZoneBlocks& b, const Moments& moments) {
  RandomPart random;
  for (const std::size_t strip : b.strips()) {
    const double weight = b.mean(moments.zeroth, strip);
    const double mean = weight > 0.0 ? b.mean(moments.first, strip) / weight : 0.0;
    random.sum += b.mean(moments.second, strip) - weight * mean * mean;
    random.terms.push_back({moments.second, 1.0, strip});
    random.terms.push_back({moments.first, -2.0 * mean, strip});
    random.terms.push_back({moments.zeroth, mean * mean, strip});
  }
  return random;
}

/// Mean over the grains of the squares of w about the mean of their strip.
Estimate variance_of_w(const ZoneBlocks& b) {
  const double grains = b.mean(StripSum::grains);
  if (grains == 0.0) return not_known;
  RandomPart random = random_part(b, of_grains);
  const double variance = random.sum / grains;
  random.terms.push_back({StripSum::grains, -variance});
  for (LinearTerm& term : random.terms) term.derivative /= grains;
  return b.mean_over_grains(variance, random.terms);
}

/// The kinetic stress along the tube, with that of the contacts if asked for.
Estimate stress_yy(const ZoneBlocks& b, double area, bool with_contacts) {
  RandomPart random = random_part(b, of_mass);
  const double contact = with_contacts ? 1.0 : 0.0;
  const double sum = random.sum + contact * b.mean(StripSum::contact_yy);
  random.terms.push_back({StripSum::contact_yy, contact});
  for (LinearTerm& term : random.terms) term.derivative /= area;
  return b.sum(sum / area, random.terms);
}

struct Quantity {
  std::string_view name, unit, meaning;
  Estimate (*of)(const ZoneBlocks&, double area);
};

using B = ZoneBlocks;
using S = StripSum;

constexpr std::array<Quantity, 16> quantities = {{
    {"area_fraction", "1", "Part of the area that grains cover.",
     [](const B& b, double a) { return density(b, a, S::area); }},
    {"density", "kg/m^2", "Mass per area, of the grains with their centre in the strip.",
     [](const B& b, double a) { return density(b, a, S::mass); }},
    {"mean_axial_velocity", "m/s", "Mean axial velocity of the grains, positive downstream.",
     [](const B& b, double) { return per_grain(b, S::vy); }},
    {"temperature_x", "m^2/s^2", "Mean of v_x^2 of the grains.",
     [](const B& b, double) { return per_grain(b, S::vx2); }},
    {"temperature_y", "m^2/s^2", "Variance of v_y of the grains about the mean of their strip.",
     [](const B& b, double) { return variance_of_w(b); }},
    {"stress_xx", "N/m", "Normal stress across the tube, positive in compression.",
     [](const B& b, double a) { return density(b, a, S::mass_vx2, S::contact_xx); }},
    {"stress_xy", "N/m", "Shear stress: momentum along y that goes to larger x.",
     [](const B& b, double a) { return density(b, a, S::mass_vx_w, S::contact_xy); }},
    {"stress_yx", "N/m", "Shear stress: momentum along x that goes to larger y.",
     [](const B& b, double a) { return density(b, a, S::mass_vx_w, S::contact_yx); }},
    {"stress_yy", "N/m", "Normal stress along the tube, positive in compression.",
     [](const B& b, double a) { return stress_yy(b, a, true); }},
    {"kinetic_stress_xx", "N/m", "The part of stress_xx that grains carry in flight.",
     [](const B& b, double a) { return density(b, a, S::mass_vx2); }},
    {"kinetic_stress_xy", "N/m", "The part of stress_xy, and of stress_yx, of grains in flight.",
     [](const B& b, double a) { return density(b, a, S::mass_vx_w); }},
    {"kinetic_stress_yy", "N/m", "The part of stress_yy that grains carry in flight.",
     [](const B& b, double a) { return stress_yy(b, a, false); }},
    {"contact_stress_xx", "N/m", "The part of stress_xx that contacts carry.",
     [](const B& b, double a) { return density(b, a, S::contact_xx); }},
    {"contact_stress_xy", "N/m", "The part of stress_xy that contacts carry.",
     [](const B& b, double a) { return density(b, a, S::contact_xy); }},
    {"contact_stress_yx", "N/m", "The part of stress_yx that contacts carry.",
     [](const B& b, double a) { return density(b, a, S::contact_yx); }},
    {"contact_stress_yy", "N/m", "The part of stress_yy that contacts carry.",
     [](const B& b, double a) { return density(b, a, S::contact_yy); }},
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
      const ZoneBlocks of_zone(blocks, zone, first);
      const double area = strips.area() * static_cast<double>(zone.size());
      profile.zones.push_back(of_zone.size() > 0 ? q.of(of_zone, area) : not_known);
    }
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace riesel
