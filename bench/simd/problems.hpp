// The pairs and contacts of a real state, for the engine and for the kernels of this folder.
#pragma once

#include "bench/simd/kernels.hpp"
#include "engine/candidates.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace riesel::bench::simd {

/// The engine's own loops.
class Original {
public:
  Original(State state, const ContactModel& model);

  void find_pairs() {
    find_overlapping(slice().pairs, positions_, candidates_.units(), slice().hits);
  }
  void step_contacts() { slice().pair_contacts.step(bodies(state_.grains), units_, model_); }

  const State& state() const { return state_; }
  const ContactModel& model() const { return model_; }
  const StepUnits& units() const { return units_; }
  Candidates& candidates() { return candidates_; }
  Slice& slice() { return candidates_.slices().front(); }

private:
  State state_;
  ContactModel model_;
  Candidates candidates_;
  PackedPositions positions_;
  StepUnits units_;
};

class PairSearch {
public:
  explicit PairSearch(Original& engine);

  double items() const { return static_cast<double>(problem_.count); }
  void pass(const Way& way) { way.find_pairs(problem_, hits_.data()); }
  /// Whether the hits are those of the engine, also where reaches are so long that there are many.
  bool agrees(const Way& way, Original& engine);

private:
  bool same_hits(const Way& way, Original& engine);

  PairProblem problem_;
  std::vector<std::uint32_t> hits_;
};

/// What LiveContacts holds of contacts between grains, in arrays of its own.
class ContactColumns {
public:
  explicit ContactColumns(Original& engine);

  double items() const { return static_cast<double>(size_); }
  void pass(const Way& way) { way.step_contacts(problem()); }
  /// Whether lives and kicks are those of the engine after as many passes.
  bool agrees(Original& engine) const;

private:
  ContactProblem problem();

  std::size_t size_;
  Bodies bodies_;
  StepUnits units_;
  LinearLaw law_;
  double friction_;
  std::array<AlignedVector<std::int64_t>, 2> body_;
  std::array<AlignedVector<double>, 4> constants_;
  std::array<AlignedVector<double>, 9> life_;
  std::array<AlignedVector<Fixed>, 4> kick_;
  AlignedVector<std::int64_t> flags_;
};

}  // namespace riesel::bench::simd
