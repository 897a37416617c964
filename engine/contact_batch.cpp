#include "engine/contact_batch.hpp"

#include "engine/vector_kernel.hpp"

#include <array>
#include <bit>

namespace riesel {

namespace {

template <class Struct>
using Members = std::array<double, sizeof(Struct) / sizeof(double)>;

/// The loop over contacts. `in` and `out` are one array for each member of Encounter and Touch.
template <class Normal, class Slip>
RIESEL_VECTOR_KERNEL void touch_loop(const double* const* in, double* const* out, std::size_t count,
                                     Normal normal, Slip slip, double mu, Attraction attraction,
                                     double dt) {
#pragma omp simd
  for (std::size_t i = 0; i < count; ++i) {
    const Encounter e{in[0][i], in[1][i], in[2][i], in[3][i],
                      in[4][i], in[5][i], in[6][i], in[7][i]};
    const Touch t = touch(e, normal, slip, mu, attraction, dt);
    out[0][i] = t.fx;
    out[1][i] = t.fy;
    out[2][i] = t.overlap;
    out[3][i] = t.rate;
    out[4][i] = t.slip;
    out[5][i] = t.since;
    out[6][i] = t.until;
    out[7][i] = t.elastic_energy;
    out[8][i] = t.normal_power;
    out[9][i] = t.friction_power;
  }
}

}  // namespace

void ContactBatch::add(const Who& who, const Encounter& encounter) {
  const std::size_t i = who_.size();
  who_.push_back(who);
  if (input_[0].size() < who_.size()) {
    for (auto& member : input_) member.resize(2 * who_.size());
    for (auto& member : output_) member.resize(2 * who_.size());
  }
  const auto members = std::bit_cast<Members<Encounter>>(encounter);
  for (std::size_t m = 0; m < inputs; ++m) input_[m][i] = members[m];
}

Touch ContactBatch::touch(std::size_t i) const {
  Members<Touch> members;
  for (std::size_t m = 0; m < outputs; ++m) members[m] = output_[m][i];
  return std::bit_cast<Touch>(members);
}

void ContactBatch::touch_all(const ContactModel& model, double dt) {
  std::array<const double*, inputs> in;
  std::array<double*, outputs> out;
  for (std::size_t m = 0; m < inputs; ++m) in[m] = input_[m].data();
  for (std::size_t m = 0; m < outputs; ++m) out[m] = output_[m].data();
  std::visit(
      [&](const auto& normal, const auto& slip) {
        touch_loop(in.data(), out.data(), size(), normal, slip, model.friction, model.attraction,
                   dt);
      },
      model.normal, model.slip);
}

}  // namespace riesel
