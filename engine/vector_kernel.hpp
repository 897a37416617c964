// Marks a function whose loops are worth compiling for each generation of vector instructions.
//
// The program starts with the clone for the machine it runs on. All clones give the same bits: the
// loops are over integers, their floating-point numbers come of +, -, *, / and sqrt alone, or these
// only choose candidates that are looked at exactly afterwards.
#pragma once

#if defined(RIESEL_VECTOR_KERNEL)  // whoever compiles has said for which machine
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)                              \
    && !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define RIESEL_VECTOR_KERNEL                                                                       \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define RIESEL_VECTOR_KERNEL
#endif
