#include "bench/flow_rows.hpp"

#include "bench/child.hpp"
#include "bench/kept_model.hpp"
#include "bench/scalar_reference.hpp"
#include "bench/traffic.hpp"
#include "engine/parallel_problems.hpp"
#include "io/checkpoint.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace riesel::bench {

namespace {

constexpr std::size_t fewest_for_memory = 50'000;      // below, a process is larger than its grains
constexpr std::size_t fewest_for_bandwidth = 500'000;  // below, caches hold a part of them

/// What a row is about to be.
struct Contender {
  Variant variant;
  std::vector<std::unique_ptr<Simulation>> runs{};
  std::uint64_t hash_after_warm_up = 0;  ///< of each run
  double contacts = 0.0;                 ///< per grain, summed over the repetitions

  const State& state() const { return runs.front()->state(); }
  /// Returns when all runs are done. A single one is not solved in a team, where it would have no
  /// threads of its own.
  void advance(std::int64_t steps) {
    if (runs.size() == 1) return runs.front()->advance(steps);
    solve_all(runs, variant.runs, [&](const auto& run) {
      run->advance(steps);
      return run->state().step;
    });
  }
};

/// Steps are the same for all variants and do not depend on the clock, so that the hashes of two
/// machines can be compared. Up to 100 k grains at least as many as lie between several sortings.
struct Plan {
  std::int64_t warm_up, steps;
  std::int64_t scalar_steps;  ///< all are alike to the scalar code, and it takes long
  /// In which `automatic` tries each way twice.
  std::int64_t settling;
  int repetitions;

  Plan(const FlowCase& one, const Effort& effort, double grains)
      : warm_up(std::llround(std::clamp(2e6 / grains, 20.0, 1000.0))),
        steps(steps_for(one.work * effort.work, grains, 1000.0)),
        scalar_steps(steps_for(std::min(one.work, 1e7) * effort.work, grains, 500.0)),
        settling(std::llround(std::max(std::max(3.6e8, 9.0 * one.work) / grains, 1200.0))),
        repetitions(std::min(effort.repetitions, grains > 2e6   ? 2
                                                 : grains > 5e5 ? 3
                                                                : 5)) {}

private:
  static std::int64_t steps_for(double work, double grains, double least) {
    return std::llround(std::max(work / grains, grains > 2e6   ? 100.0
                                                : grains > 5e5 ? 200.0
                                                               : least));
  }
};

template <class Choice>
std::string name_in(const std::map<std::string, Choice>& all, Choice choice) {
  return std::find_if(all.begin(), all.end(), [&](auto& one) { return one.second == choice; })
      ->first;
}

class FlowComparison {
public:
  FlowComparison(const FlowCase& one, const Size& size, const StartStates& states,
                 const Effort& effort)
      : name_(one.name),
        size_(size.name),
        path_(states.checkpoint(one, size)),
        start_(io::read_checkpoint(path_)),
        model_(model_of(start_)),
        grains_(start_.state.grains.size()),
        plan_(one, effort, static_cast<double>(grains_)),
        reference_(start_.state, model_) {
    for (const Variant& variant : timed_variants()) {
      if (!variant.suits(start_.state)) continue;
      contenders_.push_back(variant.stepping == Stepping::automatic ? chosen(variant)
                                                                    : warmed_up(variant));
    }
    reference_.advance(plan_.warm_up);
  }

  void measure(Results& results) {
    std::vector<Measurement> measurements;
    measurements.emplace_back(
        [this] { return seconds_of([&] { reference_.advance(plan_.scalar_steps); }); });
    for (Contender& contender : contenders_)
      measurements.emplace_back([this, &contender] { return timed(contender); });
    const std::vector<Timing> timings = in_turns(measurements, plan_.repetitions);

    add(results, row("scalar", 1, plan_.scalar_steps, timings[0]));
    for (std::size_t i = 0; i < contenders_.size(); ++i)
      add(results, row(contenders_[i], timings[i + 1], results.bandwidth));
    compare_hashes(results.disagreements);
  }

private:
  /// What the choice by the clock comes to, measured over the same steps as all others.
  Contender chosen(const Variant& variant) const {
    Simulation trial(start_.state, model_, useful_threads(grains_), Stepping::automatic);
    trial.advance(plan_.settling);
    const Way way = trial.preferred_way();
    return warmed_up({.name = variant.name,
                      .stepping = way.by_flights ? Stepping::windows : Stepping::plain,
                      .threads = way.threads,
                      .sharing = way.apart ? Sharing::apart : Sharing::together});
  }

  Contender warmed_up(const Variant& variant) const {
    Contender contender{.variant = variant};
    for (int run = 0; run < variant.runs; ++run) {
      contender.runs.push_back(std::make_unique<Simulation>(
          start_.state, model_, variant.threads, variant.stepping, Askew{}, variant.sharing));
      contender.runs.back()->advance(plan_.warm_up);
    }
    contender.hash_after_warm_up = state_hash(contender.state());
    return contender;
  }

  double timed(Contender& contender) const {
    const double seconds = seconds_of([&] { contender.advance(plan_.steps); });
    contender.contacts +=
        static_cast<double>(contender.state().contacts.size()) / static_cast<double>(grains_);
    return seconds;
  }

  Row row(const std::string& variant, int threads, std::int64_t steps, const Timing& timing) const {
    return {.case_name = name_,
            .size = size_,
            .variant = variant,
            .grains = grains_,
            .threads = threads,
            .unit = "particle-steps",
            .work = static_cast<double>(grains_) * static_cast<double>(steps),
            .timing = timing,
            .steps_before = plan_.warm_up};
  }

  Row row(const Contender& contender, const Timing& timing,
          const std::vector<Bandwidth>& bandwidth) const {
    Row result = row(contender.variant.name, contender.variant.all_threads(), plan_.steps, timing);
    result.work *= contender.variant.runs;
    result.state_hash = contender.hash_after_warm_up;
    result.contacts_per_grain = contender.contacts / static_cast<double>(plan_.repetitions);
    if (*result.contacts_per_grain > 0.0)
      result.ns_per_contact = 1e9 * timing.median() / result.work / *result.contacts_per_grain;
    add_memory(contender.variant, result);
    if (contender.variant.stepping == Stepping::plain && grains_ >= fewest_for_bandwidth)
      add_bandwidth(bandwidth, result);
    return result;
  }

  void add_memory(const Variant& variant, Row& row) const {
    if (grains_ < fewest_for_memory || variant.runs > 1) return;
    const auto answer =
        ask_child({"advance", path_.string(), "--stepping", name_in(steppings(), variant.stepping),
                   "--threads", std::to_string(variant.threads), "--sharing",
                   name_in(sharings(), variant.sharing), "--steps", "20"});
    row.bytes_per_grain = answer["memory"]["bytes_per_grain"].get<double>();
    row.peak_bytes_per_grain = answer["memory"]["peak_bytes_per_grain"].get<double>();
  }

  void add_bandwidth(const std::vector<Bandwidth>& measured, Row& row) const {
    const double traffic = plain_traffic(contenders_.front().state());
    const auto limit = bandwidth_for(measured, row.threads, traffic * static_cast<double>(grains_));
    row.bytes_per_particle_step = traffic;
    if (limit) row.bandwidth_share = traffic * row.rate() / *limit;
  }

  void compare_hashes(std::vector<std::string>& disagreements) const {
    const auto complain = [&](const std::string& variant, const char* when) {
      disagreements.push_back(fmt::format("{} {}: {} and {} differ {}", name_, size_,
                                          contenders_.front().variant.name, variant, when));
    };
    const std::uint64_t early = contenders_.front().hash_after_warm_up;
    const std::uint64_t late = state_hash(contenders_.front().state());
    for (const Contender& other : contenders_) {
      if (other.hash_after_warm_up != early) complain(other.variant.name, "after the warm-up");
      for (const auto& run : other.runs)
        if (state_hash(run->state()) != late) complain(other.variant.name, "at the end");
    }
    for (const Variant& variant : further_variants())
      if (variant.suits(start_.state) && warmed_up(variant).hash_after_warm_up != early)
        complain(variant.name, "after the warm-up");
  }

  std::string name_, size_;
  std::filesystem::path path_;
  io::Checkpoint start_;
  ContactModel model_;
  std::size_t grains_;
  Plan plan_;
  ScalarReference reference_;
  std::vector<Contender> contenders_;
};

}  // namespace

void measure_flow(const FlowCase& one, const Size& size, const StartStates& states,
                  const Effort& effort, Results& results) {
  FlowComparison(one, size, states, effort).measure(results);
}

}  // namespace riesel::bench
