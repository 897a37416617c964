// What the suite measures: a table.
//
// To add a case: a row in cases.cpp, and in docs/suite.md why it is representative.
#pragma once

#include "engine/simulation.hpp"

#include <map>
#include <string>
#include <vector>

namespace riesel::bench {

/// A tube that is `copies` times as long as that of the case's settings.
struct Size {
  std::string name;
  int copies;
};

/// Many grains that are stepped.
struct FlowCase {
  std::string name;
  std::string settings;  ///< YAML, of the scenario periodic_tube
  /// s, simulated from the fresh packing until the state from which is measured; 0 stands for the
  /// fresh packing itself.
  double relaxation;
  /// Particle-steps in one repetition of the smaller sizes: several times as many as are done
  /// between two sortings.
  double work;
  std::vector<Size> sizes;
};

/// Single grains thrown at a wall: all impacts of a curve, again and again.
struct ImpactCase {
  std::string name;
  std::string settings;  ///< YAML, of an impact scenario
  int rounds;            ///< in one repetition
};

/// A way to move the grains, to be compared with others.
struct Variant {
  std::string name;
  Stepping stepping;
  int threads;  ///< 0: as many as riesel takes by itself
  Sharing sharing = Sharing::automatic;
  /// Of the same state, side by side, each on a thread of its own: what the machine has for two
  /// threads that need not wait for each other.
  int runs = 1;

  int all_threads() const { return runs * threads; }
  /// Where memory is what counts the threads have parts of another kind: slices that go askew.
  bool suits(const State& state) const { return sharing != Sharing::apart || !Askew{}.pays(state); }
};

const std::vector<FlowCase>& flow_cases();
const std::vector<ImpactCase>& impact_cases();
/// Timed. Besides these there is the scalar reference.
const std::vector<Variant>& timed_variants();
/// Not timed, but must come to the same bits.
const std::vector<Variant>& further_variants();

/// The case with this name. Throws std::invalid_argument if there is none.
const FlowCase& flow_case(const std::string& name);
/// The size of a case with this name; any of the table will do. Throws std::invalid_argument.
Size size_named(const std::string& name);

/// The names of the steppings: "plain", "windows", "automatic".
const std::map<std::string, Stepping>& steppings();
/// Those of how threads share the steps: "together", "apart", "automatic".
const std::map<std::string, Sharing>& sharings();

}  // namespace riesel::bench
