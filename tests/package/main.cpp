// Uses a header of the engine and a function of io, so that the installed include paths and
// libraries are both tried.
#include "engine/box.hpp"
#include "io/build_info.hpp"

#include <cstdio>

int main() {
  const riesel::Box box{.width = 0.02, .length = 0.1};
  const auto& version = riesel::build_info().version;
  std::printf("riesel %.*s\n", static_cast<int>(version.size()), version.data());
  return box.metres_x(box.fixed_x(0.01)) > 0.0 ? 0 : 1;
}
