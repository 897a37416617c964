// Marks a function whose loops are worth compiling for each generation of vector instructions.
//
// The program starts with the clone for the machine it runs on. All clones give the same bits: the
// loops are over integers, their floating-point numbers come of +, -, *, / and sqrt alone, or these
// only choose candidates that are looked at exactly afterwards. What a contact law calls besides,
// such as std::pow, is the same function for all clones.
//
// Integers and doubles become each other by the instructions of AVX-512 where there are some, and
// by additions elsewhere: a loop that does so is written once, as a template, see
// run_vector_loop().
#pragma once

#include "engine/fixed_point.hpp"

#if defined(RIESEL_VECTOR_KERNEL)  // whoever compiles has said for which machine
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

/// Marks a function with a loop of which no vectors are to be made, whoever calls it.
#if defined(__GNUC__) && !defined(__clang__)
#define RIESEL_SCALAR_KERNEL __attribute__((noinline, optimize("no-tree-vectorize")))
#else
#define RIESEL_SCALAR_KERNEL [[gnu::noinline]]
#endif

namespace riesel {

/// Whether vectors of integers and doubles become each other by instructions on this machine.
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

/// Calls Loop::run<Numbers>(arguments...), a static function that is always inlined, as the best
/// clone for this machine, with the Numbers (ByConversion or ByAddition) that suit it.
template <class Loop, class... Arguments>
void run_vector_loop(const Arguments&... arguments) {
  if (vectors_convert)
    run_converting_loop<Loop>(arguments...);
  else
    run_adding_loop<Loop>(arguments...);
}

}  // namespace riesel
