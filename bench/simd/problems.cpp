#include "bench/simd/problems.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace riesel::bench::simd {

namespace {

constexpr std::size_t lanes = 8;

/// What a step writes of the life of contact i, in the order of ContactColumns.
std::array<double, 9> life_of(const LiveContacts& live, std::size_t i) {
  const Contact c = live.contact(i);
  const double on_first = live.meeting(i).turned ? -1.0 : 1.0;
  return {
      c.end,         c.overlap,       c.max_overlap,           c.elastic_energy,       c.slip_path,
      c.normal_loss, c.friction_loss, on_first * c.friction_x, on_first * c.friction_y};
}

}  // namespace

Original::Original(State state, const ContactModel& model)
    : state_(std::move(state)),
      model_(model),
      candidates_(state_, model_.slip, 1, Candidates::plain_stepping, 1),
      units_(state_) {
  positions_.copy_all(candidates_.when_sorted());
  if (!std::holds_alternative<LinearLaw>(model.normal)
      || !std::holds_alternative<CappedSlip>(model.slip) || model.attraction != Attraction::keep)
    throw std::invalid_argument("the kernels know the linear law, capped slip and attraction only");
}

PairSearch::PairSearch(Original& engine)
    : problem_{.first = engine.slice().pairs.first.data(),
               .second = engine.slice().pairs.second.data(),
               .reach2 = engine.slice().pairs.reach2.data(),
               .count = engine.slice().pairs.size(),
               .x = engine.candidates().when_sorted().x.data(),
               .y = engine.candidates().when_sorted().y.data(),
               .units = engine.candidates().units()},
      hits_(problem_.count) {}

bool PairSearch::same_hits(const Way& way, Original& engine) {
  engine.find_pairs();
  const std::size_t count = way.find_pairs(problem_, hits_.data());
  const auto theirs = engine.slice().hits.items();
  return std::equal(hits_.begin(), hits_.begin() + static_cast<std::ptrdiff_t>(count),
                    theirs.begin(), theirs.end());
}

bool PairSearch::agrees(const Way& way, Original& engine) {
  if (!same_hits(way, engine)) return false;
  auto& reach2 = engine.slice().pairs.reach2;
  const auto kept = reach2;
  for (float& one : reach2) one = std::abs(one) * 1.2F;
  const bool same = same_hits(way, engine) && !engine.slice().hits.empty();
  reach2 = kept;
  return same;
}

ContactColumns::ContactColumns(Original& engine)
    : size_(engine.slice().pair_contacts.size()),
      bodies_(bodies(engine.state().grains)),
      units_(engine.units()),
      law_(std::get<LinearLaw>(engine.model().normal)),
      friction_(engine.model().friction) {
  if (size_ == 0) throw std::invalid_argument("the state has no contacts between grains");
  const auto make_room = [&](auto& arrays) {
    for (auto& array : arrays) array.resize((size_ + lanes - 1) / lanes * lanes);
  };
  make_room(body_);
  make_room(constants_);
  make_room(life_);
  make_room(kick_);
  flags_.resize(body_[0].size());
  for (std::size_t i = 0; i < size_; ++i) {
    const LiveContacts& live = engine.slice().pair_contacts;
    const Meeting& meeting = live.meeting(i);
    const double a = meeting.mass_first, b = meeting.mass_second;
    body_[0][i] = 2 * live.first(i);
    body_[1][i] = 2 * live.second(i);
    const std::array constants = {meeting.reach(), a * b / (a + b), 1.0 / a, 1.0 / b};
    for (std::size_t m = 0; m < constants.size(); ++m) constants_[m][i] = constants[m];
    const auto life = life_of(live, i);
    for (std::size_t m = 0; m < life.size(); ++m) life_[m][i] = life[m];
  }
}

ContactProblem ContactColumns::problem() {
  return {.first = body_[0].data(),
          .second = body_[1].data(),
          .reach = constants_[0].data(),
          .reduced_mass = constants_[1].data(),
          .per_mass_first = constants_[2].data(),
          .per_mass_second = constants_[3].data(),
          .end = life_[0].data(),
          .overlap = life_[1].data(),
          .max_overlap = life_[2].data(),
          .elastic_energy = life_[3].data(),
          .slip_path = life_[4].data(),
          .normal_loss = life_[5].data(),
          .friction_loss = life_[6].data(),
          .friction_x = life_[7].data(),
          .friction_y = life_[8].data(),
          .kick_first_x = kick_[0].data(),
          .kick_first_y = kick_[1].data(),
          .kick_second_x = kick_[2].data(),
          .kick_second_y = kick_[3].data(),
          .flags = flags_.data(),
          .count = flags_.size(),
          .bodies = bodies_,
          .units = units_,
          .law = law_,
          .friction = friction_};
}

bool ContactColumns::agrees(Original& engine) const {
  const LiveContacts& live = engine.slice().pair_contacts;
  bool same = live.size() == size_ && live.ended().empty();
  for (std::size_t i = 0; same && i < size_; ++i) {
    const auto life = life_of(live, i);
    for (std::size_t m = 0; m < life.size(); ++m) same = same && life_[m][i] == life[m];
    const BodyKick first = live.kick_of_first(i), second = live.kick_of_second(i);
    same = same && first.by == FixedVector{kick_[0][i], kick_[1][i]}
           && second.by == FixedVector{kick_[2][i], kick_[3][i]};
  }
  return same;
}

}  // namespace riesel::bench::simd
