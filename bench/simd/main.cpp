// Would a library of vector types make the two hottest loops of plain stepping faster?
//
//   build/bench/bench/speed state tube_slow 10k      makes a state and says where it is
//   build/bench/bench/simd/simd STATE.h5             a table; docs/performance-log.md keeps one
//
// The engine's own loops (`omp simd`, cloned for each instruction set) and those of kernels.hpp do
// the same work on the pairs and contacts of that state, in turns. Exit status: 1 if a way comes to
// other bits than the engine, 2 for a wrong command line.
#include "bench/kept_model.hpp"
#include "bench/simd/problems.hpp"
#include "bench/simd/ways.hpp"
#include "bench/timing.hpp"
#include "io/checkpoint.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace riesel::bench::simd {

#define RIESEL_DECLARE_WAY(way) extern const Way way;
RIESEL_WAYS(RIESEL_DECLARE_WAY)

namespace {

/// Those that this processor can run.
std::vector<Way> ways() {
  std::vector<Way> all;
#define RIESEL_ADD_WAY(way) all.push_back(way);
  RIESEL_WAYS(RIESEL_ADD_WAY)
  std::erase_if(all, [](const Way& way) {
    return std::string_view(way.name).ends_with("v4") ? !__builtin_cpu_supports("avx512dq")
                                                      : !__builtin_cpu_supports("avx2");
  });
  return all;
}

struct Contender {
  std::string name;
  std::function<void()> pass;
};

/// What a pass takes per item, in ns, and as a ratio to the first contender turn by turn.
void print_table(const std::string& title, double items, const std::vector<Contender>& contenders) {
  constexpr int repetitions = 25;
  constexpr double at_a_time = 0.01;  // s
  double one_pass = 0.0;
  for (const Contender& one : contenders) one_pass = std::max(one_pass, seconds_of(one.pass));
  const int passes = std::max(1, static_cast<int>(at_a_time / one_pass));

  std::vector<Measurement> measurements;
  for (const Contender& one : contenders)
    measurements.emplace_back([&one, passes] {
      return seconds_of([&] {
        for (int i = 0; i < passes; ++i) one.pass();
      });
    });
  const std::vector<Timing> timings = in_turns(measurements, repetitions);

  fmt::print("\n{}: {:.0f}\n{:34} {:>9} {:>9} {:>9}\n", title, items, "", "ns", "best", "ratio");
  for (std::size_t i = 0; i < timings.size(); ++i) {
    Timing ratios = timings[i];
    for (std::size_t turn = 0; turn < ratios.seconds.size(); ++turn)
      ratios.seconds[turn] /= timings[0].seconds[turn];
    const double ns = 1e9 / items / passes;
    fmt::print("{:34} {:9.3f} {:9.3f} {:9.2f}\n", contenders[i].name, ns * timings[i].median(),
               ns * timings[i].least(), ratios.median());
  }
}

/// The contacts stay as they are, however often they are stepped.
State at_rest(State state) {
  Grains& g = state.grains;
  for (auto* motion : {&g.u, &g.kick}) std::fill(motion->begin(), motion->end(), FixedVector{});
  return state;
}

/// Whether one step of the contacts comes to the bits of the engine.
bool steps_alike(const Way& way, const State& state, const ContactModel& model) {
  Original engine(state, model);
  ContactColumns columns(engine);
  engine.step_contacts();
  columns.pass(way);
  return columns.agrees(engine);
}

int compare(const std::string& path) {
  constexpr auto engine_name = "engine: omp simd, clones";
  const io::Checkpoint checkpoint = io::read_checkpoint(path);
  const ContactModel model = model_of(checkpoint);
  const std::vector<Way> all = ways();
  if (all.empty()) throw std::runtime_error("this processor has neither AVX2 nor AVX-512");
  Original engine(at_rest(checkpoint.state), model);

  PairSearch search(engine);
  std::vector<Contender> searches{{engine_name, [&] { engine.find_pairs(); }}};
  for (const Way& way : all) searches.push_back({way.name, [&] { search.pass(way); }});
  print_table("Candidate pairs", search.items(), searches);

  std::vector<ContactColumns> columns(all.size(), ContactColumns(engine));
  std::vector<Contender> steps{{engine_name, [&] { engine.step_contacts(); }}};
  for (std::size_t i = 0; i < all.size(); ++i)
    steps.push_back({all[i].name, [&, i] { columns[i].pass(all[i]); }});
  print_table("Contacts of grains", columns.front().items(), steps);

  bool same = true;
  for (const Way& way : all)
    if (!search.agrees(way, engine) || !steps_alike(way, checkpoint.state, model)) {
      fmt::print(stderr, "simd: other bits than the engine: {}\n", way.name);
      same = false;
    }
  return same ? 0 : 1;
}

}  // namespace

}  // namespace riesel::bench::simd

int main(int argc, char** argv) {
  try {
    if (argc == 2) return riesel::bench::simd::compare(argv[1]);
    fmt::print(stderr, "usage: simd STATE.h5\n");
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "simd: {}\n", error.what());
    return 1;
  }
}
