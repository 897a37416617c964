#include "app/stepping.hpp"

#include <omp.h>

#include <algorithm>
#include <string>

namespace riesel::app {

namespace {

int threads_of(const io::Settings& settings, int useful) {
  const auto wanted = settings.integer_or_auto("run.threads");
  return std::min(wanted ? static_cast<int>(*wanted) : useful, omp_get_thread_limit());
}

}  // namespace

Stepping stepping_of(const io::Settings& settings) {
  const std::string& choice = settings.text("run.stepping");
  if (choice == "plain") return Stepping::plain;
  if (choice == "windows") return Stepping::windows;
  return Stepping::automatic;
}

int threads_for(const io::Settings& settings, std::size_t grains) {
  return threads_of(settings, useful_threads(grains));
}

int threads_for_curve(const io::Settings& settings) {
  return threads_of(settings, omp_get_max_threads());
}

}  // namespace riesel::app
