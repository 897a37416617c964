// The kernels with one library and for one set of instructions, as CMakeLists.txt says.
#include RIESEL_LANES
#include "bench/simd/kernels.hpp"

namespace riesel::bench::simd {

extern const Way RIESEL_WAY;
const Way RIESEL_WAY = {RIESEL_WAY_NAME, find_pairs<Lanes>, step_contacts<Lanes>};

}  // namespace riesel::bench::simd
