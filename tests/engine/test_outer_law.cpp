// A law from outside of the library does what the same law of the library does, to the last bit.
#include "engine/contact_law.hpp"
#include "tests/catch.hpp"
#include "tests/engine/same_states.hpp"
#include "tests/engine/systems.hpp"

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

}  // namespace

TEST_CASE("a law from outside has the functions of its type") {
  check_functions(LinearLaw{2000.0, 1e4});
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
