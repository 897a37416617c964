// A sweep cut into parts for a batch system: one task does one part, its points one after the
// other. Points that continue each other are in the same part.
#pragma once

#include "io/sweep_manifest.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace riesel::app {

/// The largest useful number of parts: one for each chain of continued points or single point.
std::size_t most_parts(const io::Manifest& manifest);

/// The names of the points in each of `count` parts, in the order in which they are to be run.
/// Parts beyond most_parts() are empty.
std::vector<std::vector<std::string>> parts_of(const io::Manifest& manifest, std::size_t count);

}  // namespace riesel::app
