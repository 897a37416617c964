#include "app/stepping.hpp"

#include <string>

namespace riesel::app {

void check_stepping(const io::Settings& settings) {
  const bool one_thread = settings.integer_or_auto("run.threads").value_or(1) == 1;
  if (stepping_of(settings) == Stepping::windows && !one_thread)
    settings.reject("run.stepping", "windows are stepped on one thread",
                    "set run.threads to 1, or run.stepping to auto");
}

Stepping stepping_of(const io::Settings& settings) {
  const std::string& choice = settings.text("run.stepping");
  if (choice == "plain") return Stepping::plain;
  if (choice == "windows") return Stepping::windows;
  return Stepping::automatic;
}

int threads_for(const io::Settings& settings, std::size_t grains) {
  if (stepping_of(settings) == Stepping::windows) return 1;
  const auto wanted = settings.integer_or_auto("run.threads");
  return wanted ? static_cast<int>(*wanted) : useful_threads(grains);
}

}  // namespace riesel::app
