#include "app/stepping.hpp"

#include <omp.h>

#include <algorithm>
#include <string>

namespace riesel::app {

namespace {

int wanted_threads(const io::Settings& settings, int useful) {
  const auto wanted = settings.integer_or_auto("run.threads");
  return wanted ? static_cast<int>(*wanted) : useful;
}

int threads_of(const io::Settings& settings, int useful) {
  return std::min(wanted_threads(settings, useful), omp_get_thread_limit());
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

int most_threads_for(const io::Settings& settings, std::size_t grains) {
  return wanted_threads(settings, useful_threads(grains, io::most_threads));
}

int most_threads_for_curve(const io::Settings& settings) {
  return wanted_threads(settings, io::most_threads);
}

}  // namespace riesel::app
