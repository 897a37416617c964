// Thousands of random set-ups and impacts: runs in minutes, by hand. A few of each are tested
// wherever the tests run (test_properties.cpp).
//
//   properties set-ups FIRST COUNT     complains of those that are not as they must be
//   properties flows FIRST COUNT       likewise, of flows that go on for long
//   properties impacts FIRST COUNT     prints the largest gains of energy
//   properties hashes FIRST COUNT      prints the state hashes of each set-up, of plain stepping on
//                                      one thread and of windows on two: to compare two builds
#include "engine/state.hpp"
#include "tests/properties/properties.hpp"
#include "tests/scratch_directory.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace {

using namespace properties;

void print(std::uint64_t seed, const SetUp& set_up, const Complaints& complaints) {
  std::printf("%llu: %s\n", static_cast<unsigned long long>(seed), description(set_up).c_str());
  for (const auto& complaint : complaints) std::printf("    %s\n", complaint.c_str());
}

int check_set_ups(std::uint64_t first, std::uint64_t count) {
  const riesel::ScratchDirectory scratch;
  std::uint64_t wrong = 0, failures = 0, without_contacts = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const SetUp set_up = random_set_up(seed);
    const Outcome expected = reference(set_up);
    if (!expected.failure.empty())
      ++failures;
    else if (contacts_begun(expected.end) == 0)
      ++without_contacts;
    Complaints complaints = same_bits(set_up, expected, seed, scratch.path());
    for (const auto& more : balances(set_up, expected)) complaints.push_back(more);
    if (complaints.empty()) continue;
    ++wrong;
    print(seed, set_up, complaints);
  }
  std::printf(
      "%llu set-ups, %llu of them wrong; in %llu a run has a reason to fail, in %llu nothing "
      "touches\n",
      static_cast<unsigned long long>(count), static_cast<unsigned long long>(wrong),
      static_cast<unsigned long long>(failures), static_cast<unsigned long long>(without_contacts));
  return wrong == 0 ? 0 : 1;
}

int check_flows(std::uint64_t first, std::uint64_t count) {
  std::uint64_t wrong = 0;
  std::int64_t contacts = 0;
  double contact_steps = 0.0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const SetUp flow = random_flow(seed);
    const Outcome expected = reference(flow);
    // Teams are slow on a busy machine: only some.
    const Complaints complaints = same_by_windows(flow, expected, seed % 50 == 0 ? 2 : 1);
    for (const riesel::ContactTally* kind :
         {&expected.end.tally.grains, &expected.end.tally.walls}) {
      contacts += kind->ended;
      contact_steps += kind->duration.value() / flow.start.time_step;
    }
    if (complaints.empty()) continue;
    ++wrong;
    print(seed, flow, complaints);
  }
  std::printf("%llu flows, %llu of them wrong; %lld contacts, of %.3g steps together\n",
              static_cast<unsigned long long>(count), static_cast<unsigned long long>(wrong),
              static_cast<long long>(contacts), contact_steps);
  return wrong == 0 ? 0 : 1;
}

/// By law and by decade of the number of steps.
int print_gains(std::uint64_t first, std::uint64_t count) {
  constexpr std::array laws{"linear", "equal restitution", "power", "Hertz"};
  constexpr std::array slips{"capped", "literal", "viscous", "spring"};
  constexpr std::array lowest{10.0, 20.0, 50.0, 100.0};
  std::array<std::array<std::array<double, lowest.size()>, slips.size()>, laws.size()> most{};
  std::array<std::array<std::array<int, lowest.size()>, slips.size()>, laws.size()> counts{};
  for (auto& law : most)
    for (auto& slip : law) slip.fill(-1.0);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Impact impact = random_impact(seed);
    std::size_t row = lowest.size() - 1;
    while (row > 0 && impact.steps_per_contact < lowest.at(row)) --row;
    auto& cell = most.at(impact.model.normal.index()).at(impact.model.slip.index()).at(row);
    cell = std::max(cell, impact.gain);
    ++counts.at(impact.model.normal.index()).at(impact.model.slip.index()).at(row);
  }
  std::puts("| law | slip | steps per contact from | impacts | largest gain |");
  std::puts("|---|---|--:|--:|--:|");
  for (std::size_t law = 0; law < laws.size(); ++law)
    for (std::size_t slip = 0; slip < slips.size(); ++slip)
      for (std::size_t row = 0; row < lowest.size(); ++row)
        if (counts.at(law).at(slip).at(row) > 0)
          std::printf("| %s | %s | %.0f | %d | %.1e |\n", laws.at(law), slips.at(slip),
                      lowest.at(row), counts.at(law).at(slip).at(row),
                      most.at(law).at(slip).at(row));
  return 0;
}

int print_hashes(std::uint64_t first, std::uint64_t count) {
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const SetUp set_up = random_set_up(seed);
    const auto hash = [](const Outcome& outcome) {
      return outcome.failure.empty()
                 ? static_cast<unsigned long long>(riesel::state_hash(outcome.end))
                 : 0ULL;
    };
    std::printf("%llu %016llx %016llx %zu\n", static_cast<unsigned long long>(seed),
                hash(reference(set_up)), hash(by_windows(set_up)), set_up.model.normal.index());
  }
  return 0;
}

struct Task {
  std::string_view word;
  int (*act)(std::uint64_t first, std::uint64_t count);
};
constexpr std::array tasks{Task{"set-ups", check_set_ups}, Task{"flows", check_flows},
                           Task{"impacts", print_gains}, Task{"hashes", print_hashes}};

/// Nothing if it is anything but digits, or too large.
std::optional<std::uint64_t> number(std::string_view text) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && last == end ? std::optional(value) : std::nullopt;
}

/// The exit status.
int answer(const std::vector<std::string_view>& words) {
  if (words.size() == 3) {
    const auto* const task = std::ranges::find(tasks, words[0], &Task::word);
    const auto first = number(words[1]), count = number(words[2]);
    // Of seeds there is one at least, and none beyond the largest number.
    if (task != tasks.end() && first && count && *first + *count > *first)
      return task->act(*first, *count);
  }
  std::fputs("usage: properties (set-ups | flows | impacts | hashes) FIRST COUNT\n", stderr);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return answer({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
