// Marks functions that are compiled for each generation of vector instructions.
//
// At its start the program picks the clone for its machine. All clones give the same bits: loops
// use integers, and floating-point numbers either come from +, -, *, / and sqrt alone or only
// choose candidates that are tested exactly afterwards. Anything else that a contact law calls,
// such as std::pow, is one function shared by all clones.
//
// Vectors of integers and doubles are converted by the instructions of AVX-512 where these exist,
// and by additions elsewhere. A loop that converts is written once, as a template: see
// run_vector_loop().
#pragma once

#include "engine/fixed_point.hpp"

#if defined(RIESEL_VECTOR_KERNEL)  // on the command line, to compile for one machine: no clones
#define RIESEL_KERNEL_THAT_ADDS
#define RIESEL_KERNEL_THAT_CONVERTS
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)                              \
    && !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define RIESEL_VECTOR_KERNEL                                                                       \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define RIESEL_KERNEL_THAT_ADDS __attribute__((target_clones("arch=x86-64-v3", "default")))
#define RIESEL_KERNEL_THAT_CONVERTS __attribute__((target("arch=x86-64-v4")))
#define RIESEL_CLONES
#else
#define RIESEL_VECTOR_KERNEL
#define RIESEL_KERNEL_THAT_ADDS
#define RIESEL_KERNEL_THAT_CONVERTS
#endif

/// Marks a function whose loop must not be vectorised, even if its caller is a vector kernel.
#if defined(__GNUC__) && !defined(__clang__)
#define RIESEL_SCALAR_KERNEL __attribute__((noinline, optimize("no-tree-vectorize")))
#else
#define RIESEL_SCALAR_KERNEL [[gnu::noinline]]
#endif

namespace riesel {

/// Whether this machine has instructions that convert between vectors of integers and doubles.
#if defined(RIESEL_CLONES)
inline const bool vectors_convert = __builtin_cpu_supports("x86-64-v4") != 0;
#elif defined(__AVX512DQ__)
inline constexpr bool vectors_convert = true;
#else
inline constexpr bool vectors_convert = false;
#endif

template <class Loop, class... Arguments>
RIESEL_KERNEL_THAT_CONVERTS void run_converting_loop(const Arguments&... arguments) {
  Loop::template run<ByConversion>(arguments...);
}

template <class Loop, class... Arguments>
RIESEL_KERNEL_THAT_ADDS void run_adding_loop(const Arguments&... arguments) {
  Loop::template run<ByAddition>(arguments...);
}

/// Calls Loop::run<Numbers>(arguments...) in the best clone for this machine, with the Numbers
/// (ByConversion or ByAddition) that suit it. run() must be a static function that is always
/// inlined.
template <class Loop, class... Arguments>
void run_vector_loop(const Arguments&... arguments) {
  if (vectors_convert)
    run_converting_loop<Loop>(arguments...);
  else
    run_adding_loop<Loop>(arguments...);
}

}  // namespace riesel
