// A law from outside of the library does what the same law of the library does, to the last bit.
#include "engine/contact_law.hpp"
#include "tests/catch.hpp"
#include "tests/engine/same_states.hpp"
#include "tests/engine/systems.hpp"

#include <cmath>
#include <stdexcept>
#include <variant>

using namespace systems;
using same_states::same;

namespace {

template <class Law>
void check_functions(const Law& law) {
  const OuterLaw outer(law);
  const double xi = 1.3e-5, rate = -0.7, m_red = 2e-7;
  CHECK(outer.elastic(xi) == law.elastic(xi));
  CHECK(outer.damping(xi, rate, m_red) == law.damping(xi, rate, m_red));
  CHECK(outer.stored_energy(xi) == law.stored_energy(xi));
  CHECK(outer.elastic_line().stiffness == law.elastic_line().stiffness);
  CHECK(outer.elastic_line().exponent == law.elastic_line().exponent);
}

/// As a law that looks its forces up in a table might: it may be asked for real overlaps only.
struct StrictLaw {
  LinearLaw law;

  static void demand(bool sound) {
    if (!sound) throw std::logic_error("a law is asked for a contact that is none");
  }
  double elastic(double xi) const {
    demand(xi > 0.0);
    return law.elastic(xi);
  }
  double damping(double xi, double rate, double m_red) const {
    demand(xi > 0.0 && std::isfinite(rate) && m_red > 0.0);
    return law.damping(xi, rate, m_red);
  }
  double stored_energy(double xi) const {
    demand(xi > 0.0);
    return law.stored_energy(xi);
  }
  ElasticLine elastic_line() const { return law.elastic_line(); }
};

}  // namespace

TEST_CASE("a law from outside is called for bodies that touch, and for no others") {
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  ContactModel inside = paper_model(), outside = paper_model();
  outside.normal = OuterLaw(StrictLaw{std::get<LinearLaw>(inside.normal)});
  const State start = small_tube(31);
  const State end = advanced(start, inside, 600, 1, stepping);
  CHECK(end.tally.grains.ended > 20);
  CHECK(same(advanced(start, outside, 600, 1, stepping), end));
}

TEST_CASE("a law from outside has the functions of its type") {
  check_functions(LinearLaw{2000.0, 1e4});
  check_functions(EqualRestitutionLaw{{2000.0, 7.0}});
  check_functions(PowerLaw{2e4, 1e-2, 1.2, 0.2, 1.1});
  check_functions(HertzKuwabaraKonoLaw{5e5, 3.3});
}

TEST_CASE("a law from outside gives the same bits as that of the library") {
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  const HertzKuwabaraKonoLaw hertz{5e5, 3.3};
  ContactModel inside = paper_model(), outside = paper_model();
  inside.normal = hertz;
  outside.normal = OuterLaw(hertz);
  const State start = small_tube(31);
  const State end = advanced(start, inside, 600, 2, stepping);
  CHECK(end.tally.grains.begun > 20);
  CHECK(same(advanced(start, outside, 600, 2, stepping), end));
}
