#include "app/stepping.hpp"

#include <omp.h>

#include <algorithm>
#include <string>

namespace riesel::app {

Stepping stepping_of(const io::Settings& settings) {
  const std::string& choice = settings.text("run.stepping");
  if (choice == "plain") return Stepping::plain;
  if (choice == "windows") return Stepping::windows;
  return Stepping::automatic;
}

int threads_for(const io::Settings& settings, std::size_t grains) {
  const auto wanted = settings.integer_or_auto("run.threads");
  const int threads = wanted ? static_cast<int>(*wanted) : useful_threads(grains);
  return std::min(threads, omp_get_thread_limit());
}

}  // namespace riesel::app
