// Whether two states are the same to the last bit.
#pragma once

#include "engine/observables.hpp"
#include "engine/state.hpp"
#include "tests/bits.hpp"
#include "tests/ordered_grains.hpp"

namespace same_states {

using namespace riesel;

inline std::string bits_by_id(State state) {
  state.grains = ordered_by_id(state.grains);
  return bits_of(state);
}

/// Every bit that a state holds, whether it is in the hash or not, but for the order of the grains.
inline bool same(const State& a, const State& b) {
  return bits_by_id(a) == bits_by_id(b) && a.tally.ended_at_walls.empty()
         && state_hash(a) == state_hash(b)
         && bits_of(observe(a).energies.residual) == bits_of(observe(b).energies.residual);
}

}  // namespace same_states
