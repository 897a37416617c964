#include "bench/cases.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

namespace riesel::bench {

namespace {

const Size grains_1k{"1.4k", 1}, grains_10k{"10k", 7}, grains_100k{"100k", 71},
    grains_1m{"1M", 714}, grains_4m{"4M", 2857};

/// The defaults of the scenario are those of scenarios/periodic_tube.yaml.
std::string tube(const std::string& contact, const std::string& rest) {
  return "{scenario: periodic_tube, contact: {" + contact + "}, run: {duration: 1}, " + rest + "}";
}

constexpr auto slow_start = "start: {axial_velocity: 1 m/s, random_velocity: 0.5 m/s}";

}  // namespace

const std::vector<FlowCase>& flow_cases() {
  static const std::vector<FlowCase> table = {
      {.name = "tube_slow",
       .settings = tube("stiffness: 2000 N/m, restitution: 0.9", slow_start),
       .relaxation = 1.0,
       .work = 1e7,
       .sizes = {grains_1k, grains_10k, grains_100k, grains_1m, grains_4m}},
      {.name = "tube_stiff",
       .settings = tube("stiffness: 200000 N/m, restitution: 0.9", slow_start),
       .relaxation = 1.0,
       .work = 4e8,
       .sizes = {grains_1k, grains_10k, grains_100k}},
      {.name = "tube_fast",
       .settings = tube("stiffness: 2000 N/m, restitution: 0.6",
                        "wall: {spacing: 0.66 mm}, start: {axial_velocity: 28 m/s}"),
       .relaxation = 1.0,
       .work = 1e7,
       .sizes = {grains_1k, grains_10k, grains_100k}},
      {.name = "tube_start",
       .settings = tube("stiffness: 2000 N/m, restitution: 0.92", slow_start),
       .relaxation = 0.0,
       .work = 1e7,
       .sizes = {grains_1k, grains_10k, grains_100k}},
      {.name = "dense_cold",
       .settings = tube("stiffness: 2000 N/m, restitution: 0.6",
                        "grains: {area_fraction: 0.80}, gravity: 0, "
                        "start: {axial_velocity: 0, random_velocity: 0.05 m/s}"),
       .relaxation = 0.2,
       .work = 1e7,
       .sizes = {grains_1k, grains_10k, grains_100k}},
      {.name = "dense_sheared",
       .settings = tube("stiffness: 2000 N/m, restitution: 0.8",
                        "grains: {area_fraction: 0.75}, " + std::string(slow_start)),
       .relaxation = 0.3,
       .work = 1e7,
       .sizes = {grains_1k, grains_10k, grains_100k}},
  };
  return table;
}

const std::vector<ImpactCase>& impact_cases() {
  static const std::vector<ImpactCase> table = {
      {.name = "single_wall_grain",
       .settings = "{scenario: single_wall_grain, contact: {stiffness: 2000, damping: 1e4}}",
       .rounds = 40},
      {.name = "wall_array",
       .settings = "{scenario: wall_array, contact: {stiffness: 2000, damping: 1e4}}",
       .rounds = 1},
  };
  return table;
}

const std::vector<Variant>& timed_variants() {
  static const std::vector<Variant> table = {
      {.name = "plain 1", .stepping = Stepping::plain, .threads = 1},
      {.name = "plain 2", .stepping = Stepping::plain, .threads = 2, .sharing = Sharing::together},
      {.name = "plain 2 apart",
       .stepping = Stepping::plain,
       .threads = 2,
       .sharing = Sharing::apart},
      {.name = "plain 2 runs", .stepping = Stepping::plain, .threads = 1, .runs = 2},
      {.name = "windows 1", .stepping = Stepping::windows, .threads = 1},
      {.name = "windows 2",
       .stepping = Stepping::windows,
       .threads = 2,
       .sharing = Sharing::together},
      {.name = "windows 2 apart",
       .stepping = Stepping::windows,
       .threads = 2,
       .sharing = Sharing::apart},
      {.name = "windows 2 runs", .stepping = Stepping::windows, .threads = 1, .runs = 2},
      {.name = "automatic", .stepping = Stepping::automatic, .threads = 0},
  };
  return table;
}

const std::vector<Variant>& further_variants() {
  static const std::vector<Variant> table = [] {
    std::vector<Variant> all;
    for (const auto& [sharing, shared] : sharings())
      for (const auto& [stepping, stepped] : steppings())
        for (const int threads : {3, 4})
          if (stepped != Stepping::automatic && shared != Sharing::automatic)
            all.push_back({.name = fmt::format("{} {} {}", stepping, threads, sharing),
                           .stepping = stepped,
                           .threads = threads,
                           .sharing = shared});
    return all;
  }();
  return table;
}

const FlowCase& flow_case(const std::string& name) {
  for (const FlowCase& one : flow_cases())
    if (one.name == name) return one;
  throw std::invalid_argument("there is no case '" + name + "' of many grains");
}

Size size_named(const std::string& name) {
  for (const FlowCase& one : flow_cases())
    for (const Size& size : one.sizes)
      if (size.name == name) return size;
  throw std::invalid_argument("there is no size '" + name + "'");
}

const std::map<std::string, Stepping>& steppings() {
  static const std::map<std::string, Stepping> table = {{"plain", Stepping::plain},
                                                        {"windows", Stepping::windows},
                                                        {"automatic", Stepping::automatic}};
  return table;
}

const std::map<std::string, Sharing>& sharings() {
  static const std::map<std::string, Sharing> table = {{"together", Sharing::together},
                                                       {"apart", Sharing::apart},
                                                       {"automatic", Sharing::automatic}};
  return table;
}

}  // namespace riesel::bench
