// A normal law from outside of the library, in a form that NormalLaw can hold: pointers to its
// functions instead of its type.
//
// The kernel of the contact loop is compiled once for each law of the library, and once for all
// laws from outside. That version calls functions for each contact and is not vectorised: for the
// cost see docs/extending.md. Laws of the library pay nothing for it. The kernel also computes
// lanes in which no bodies touch, and discards what comes out: for these nothing is called.
#pragma once

#include "engine/elastic_line.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace riesel {

class OuterLaw {
public:
  /// Wraps any trivially copyable type of at most 64 bytes that has the functions which
  /// contact_law.hpp lists for a normal law.
  template <class Law>
  explicit OuterLaw(const Law& law) : functions_(&functions_of<Law>) {
    static_assert(std::is_trivially_copyable_v<Law> && sizeof(Law) <= sizeof(values_));
    std::memcpy(values_.data(), &law, sizeof(Law));
  }

  double elastic(double xi) const { return xi > 0.0 ? functions_->elastic(values_, xi) : 0.0; }
  double damping(double xi, double rate, double m_red) const {
    return xi > 0.0 ? functions_->damping(values_, xi, rate, m_red) : 0.0;
  }
  double stored_energy(double xi) const {
    return xi > 0.0 ? functions_->stored_energy(values_, xi) : 0.0;
  }
  ElasticLine elastic_line() const { return functions_->elastic_line(values_); }

private:
  static constexpr std::size_t most_numbers = 8;
  using Values = std::array<double, most_numbers>;

  struct Functions {
    double (*elastic)(const Values&, double);
    double (*damping)(const Values&, double, double, double);
    double (*stored_energy)(const Values&, double);
    ElasticLine (*elastic_line)(const Values&);
  };

  template <class Law>
  static Law law_in(const Values& values) {
    std::array<std::byte, sizeof(Law)> bytes;
    std::memcpy(bytes.data(), values.data(), sizeof(Law));
    return std::bit_cast<Law>(bytes);
  }

  template <class Law>
  static constexpr Functions functions_of = {
      .elastic = [](const Values& v, double xi) { return law_in<Law>(v).elastic(xi); },
      .damping = [](const Values& v, double xi, double rate,
                    double m_red) { return law_in<Law>(v).damping(xi, rate, m_red); },
      .stored_energy = [](const Values& v, double xi) { return law_in<Law>(v).stored_energy(xi); },
      .elastic_line = [](const Values& v) { return law_in<Law>(v).elastic_line(); }};

  Values values_{};
  const Functions* functions_;
};

}  // namespace riesel
