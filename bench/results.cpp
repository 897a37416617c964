#include "bench/results.hpp"

#include "io/build_info.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <utility>

namespace riesel::bench {

namespace {

using Json = nlohmann::ordered_json;

Json json(const Timing& timing) {
  return {{"min", timing.least()}, {"median", timing.median()}, {"all", timing.seconds}};
}

Json json(const Machine& machine) {
  Json caches = Json::array();
  for (const Cache& cache : machine.caches)
    caches.push_back({{"level", cache.level}, {"kind", cache.kind}, {"bytes", cache.bytes}});
  return {{"name", machine.name()},   {"cpu", machine.cpu},
          {"cores", machine.cores},   {"caches", caches},
          {"memory", machine.memory}, {"load_average", machine.load_average}};
}

Json json_of_build() {
  const BuildInfo& build = build_info();
  return {{"version", build.version},   {"commit", build.git_commit},
          {"changed", build.git_dirty}, {"compiler", build.compiler},
          {"flags", build.flags},       {"build_type", build.build_type}};
}

Json json(const Bandwidth& b) {
  return {{"threads", b.threads},
          {"working_set", b.working_set},
          {"bytes_per_second", b.bytes_per_second()},
          {"seconds", json(b.timing)}};
}

template <class T>
Json json(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json(const Row& row) {
  return {{"case", row.case_name},
          {"size", row.size},
          {"variant", row.variant},
          {"grains", row.grains},
          {"threads", row.threads},
          {"unit", row.unit},
          {"work", row.work},
          {"seconds", json(row.timing)},
          {"per_second", {{"median", row.rate()}, {"max", row.best_rate()}}},
          {"contacts_per_grain", json(row.contacts_per_grain)},
          {"ns_per_contact", json(row.ns_per_contact)},
          {"bytes_per_grain", json(row.bytes_per_grain)},
          {"peak_bytes_per_grain", json(row.peak_bytes_per_grain)},
          {"bytes_per_particle_step", json(row.bytes_per_particle_step)},
          {"bandwidth_share", json(row.bandwidth_share)},
          {"steps_before", row.steps_before},
          {"state_hash", row.state_hash ? Json(fmt::format("{:016x}", *row.state_hash)) : Json()}};
}

/// In millions of its unit per second; a start in s.
std::string speed_of(const Row& row, double seconds) {
  return row.unit == "starts" ? fmt::format("{:.2f} s", seconds)
                              : fmt::format("{:.4g}", 1e-6 * row.work / seconds);
}

std::string cell(const std::optional<double>& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

}  // namespace

void print_machine(const Results& results) {
  const Machine& machine = results.machine;
  fmt::print("riesel {} {}{}, {} {}\n{}, {} cores, {:.0f} GiB, load {:.2f}\n", build_info().version,
             build_info().git_commit.substr(0, 7), build_info().git_dirty ? " (changed)" : "",
             build_info().compiler, build_info().flags, machine.cpu, machine.cores,
             static_cast<double>(machine.memory) / 0x1p30, machine.load_average[0]);
  for (const Bandwidth& b : results.bandwidth)
    fmt::print("triad over {:.0f} MiB, {} thread{}: {:.1f} GB/s\n",
               static_cast<double>(b.working_set) / 0x1p20, b.threads, b.threads == 1 ? "" : "s",
               1e-9 * b.bytes_per_second());
}

constexpr auto row_format = "{:18} {:>5} {:>9} {:15} {:>9} {:>9} {:>9} {:>8} {:>6} {:>6}  {}\n";

void print_heading() {
  fmt::print(
      "\nSpeeds in millions of particle-steps, impacts or bytes per second, of the median "
      "repetition and of\n"
      "the best one; contacts per grain; ns: time of a step over its contacts; bytes of memory "
      "per grain;\n"
      "the part of the memory bandwidth that plain stepping would need if each step went through "
      "all grains\n\n");
  fmt::print(row_format, "case", "size", "grains", "variant", "median", "best", "contacts", "ns",
             "bytes", "part", "state hash");
  std::fflush(stdout);
}

void add(Results& results, Row row) {
  fmt::print(row_format, row.case_name, row.size, row.grains, row.variant,
             speed_of(row, row.timing.median()), speed_of(row, row.timing.least()),
             cell(row.contacts_per_grain, "{:.4f}"), cell(row.ns_per_contact, "{:.1f}"),
             cell(row.bytes_per_grain, "{:.0f}"), cell(row.bandwidth_share, "{:.2f}"),
             row.state_hash ? fmt::format("{:016x}", *row.state_hash) : "-");
  std::fflush(stdout);
  results.rows.push_back(std::move(row));
}

nlohmann::ordered_json origin(const Machine& machine) {
  return {{"machine", json(machine)}, {"build", json_of_build()}};
}

nlohmann::ordered_json to_json(const Results& results) {
  Json bandwidth = Json::array(), rows = Json::array();
  for (const Bandwidth& b : results.bandwidth) bandwidth.push_back(json(b));
  for (const Row& row : results.rows) rows.push_back(json(row));
  Json all = {{"format", "riesel benchmark"},
              {"format_version", 1},
              {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
              {"quick", results.quick},
              {"part", results.part}};
  all.update(origin(results.machine));
  all.update({{"bandwidth", bandwidth},
              {"hashes_agree", results.disagreements.empty()},
              {"disagreements", results.disagreements},
              {"rows", rows}});
  return all;
}

std::filesystem::path usual_place(const Results& results, const std::filesystem::path& folder) {
  const std::string name =
      fmt::format("{}-{}{}{}{}", results.machine.name(), build_info().git_commit.substr(0, 7),
                  build_info().git_dirty ? "-changed" : "", results.quick ? "-quick" : "",
                  results.part ? "-part" : "");
  auto path = folder / (name + ".json");
  for (int number = 2; std::filesystem::exists(path); ++number)
    path = folder / fmt::format("{}-{}.json", name, number);
  return path;
}

std::optional<double> bandwidth_for(const std::vector<Bandwidth>& measured, int threads,
                                    double bytes) {
  // First by what of `bytes` the set holds, then by speed.
  const auto merit = [&](const Bandwidth& b) {
    return std::pair(std::min(static_cast<double>(b.working_set), bytes), b.bytes_per_second());
  };
  const Bandwidth* best = nullptr;
  for (const Bandwidth& b : measured)
    if (b.threads == threads && (best == nullptr || merit(*best) < merit(b))) best = &b;
  return best == nullptr ? std::nullopt : std::optional(best->bytes_per_second());
}

}  // namespace riesel::bench
