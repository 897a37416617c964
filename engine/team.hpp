// Work that all threads of a team do together.
#pragma once

#include "engine/run_failure.hpp"

#include <omp.h>

#include <cstddef>

namespace riesel {

/// Returns how many threads the system grants to a team that wants `wanted` of them. Switches off
/// OMP_DYNAMIC, so that later teams of the calling thread do not get fewer when the machine is
/// busy: each thread has its slice.
inline int fix_members(int wanted) {
  omp_set_dynamic(0);
  int granted = 1;
#pragma omp parallel num_threads(wanted)
#pragma omp single
  granted = omp_get_num_threads();
  return granted;
}

/// Calls work(member) in each thread of a team of so many, whose members wait for each other at
/// TeamBarriers alone. Throws RunFailure, and does nothing, if the system grants fewer. What `work`
/// throws in a team of several ends the program, as the others would wait for ever.
template <class Work>
void as_a_team(int members, Work work) {
  if (members == 1) {  // without OpenMP, which makes system calls for a team of one, too
    work(std::size_t{0});
    return;
  }
  bool complete = true;
#pragma omp parallel num_threads(members)
  if (omp_get_num_threads() == members) {
    work(static_cast<std::size_t>(omp_get_thread_num()));
  } else {
#pragma omp atomic write
    complete = false;  // all threads of the team come here, or none
  }
  if (!complete) throw RunFailure("the system grants fewer threads than the run was to have");
}

}  // namespace riesel
