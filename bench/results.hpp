// The results of a run of the suite: rows on the screen and in a JSON file.
#pragma once

#include "bench/machine.hpp"
#include "bench/timing.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace riesel::bench {

/// One variant of one case in one size. SI units.
struct Row {
  std::string case_name, size, variant;
  std::size_t grains = 0;
  int threads = 1;
  std::string unit;               ///< of the work: "particle-steps", "impacts", "bytes", "starts"
  double work = 0.0;              ///< in one repetition
  Timing timing{};                ///< of the repetitions
  std::int64_t steps_before = 0;  ///< done between the start state and the first repetition
  std::optional<std::uint64_t>
      state_hash{};  ///< after these; of all results where there is no state
  std::optional<double> contacts_per_grain{};       ///< mean over the repetitions
  std::optional<double> ns_per_contact{};           ///< time of a step over its contacts
  std::optional<double> bytes_per_grain{};          ///< growth of the process's resident memory
  std::optional<double> peak_bytes_per_grain{};     ///< growth of its peak
  std::optional<double> bytes_per_particle_step{};  ///< if a step goes through all: traffic.hpp
  std::optional<double> bandwidth_share{};          ///< that times speed over bandwidth

  double rate() const { return work / timing.median(); }  ///< 1/s
  double best_rate() const { return work / timing.least(); }
};

struct Results {
  Machine machine;
  bool quick = false;
  bool part = false;  ///< of the cases or sizes
  std::vector<Bandwidth> bandwidth{};
  std::vector<Row> rows{};
  std::vector<std::string> disagreements{};  ///< of hashes that must be equal, in words
};

void print_machine(const Results& results);
void print_heading();
/// Prints it, and keeps it.
void add(Results& results, Row row);

/// Where results come from: {"machine": ..., "build": ...}.
nlohmann::ordered_json origin(const Machine& machine);

nlohmann::ordered_json to_json(const Results& results);

/// bench/results/<machine>-<commit>.json, with "-changed" where the sources were, "-quick",
/// "-part", and a number if that is there already.
std::filesystem::path usual_place(const Results& results, const std::filesystem::path& folder);

/// B/s by `threads` threads over the fastest measured working set that holds `bytes`, or over the
/// largest if none does.
std::optional<double> bandwidth_for(const std::vector<Bandwidth>& measured, int threads,
                                    double bytes);

}  // namespace riesel::bench
