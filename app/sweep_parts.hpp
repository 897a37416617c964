// A sweep cut into parts, for batch systems that run many tasks: each is done by one task, one
// point after the other. Points that continue each other are in the same part.
#pragma once

#include "io/sweep_manifest.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace riesel::app {

/// How many parts there can be at most: chains of points, and points that stand alone.
std::size_t most_parts(const io::Manifest& manifest);

/// The names of the points in each of `count` parts; those to come first stand first. Parts beyond
/// most_parts() are empty.
std::vector<std::vector<std::string>> parts_of(const io::Manifest& manifest, std::size_t count);

}  // namespace riesel::app
