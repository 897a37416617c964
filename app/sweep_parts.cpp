#include "app/sweep_parts.hpp"

#include <map>
#include <set>

namespace riesel::app {

namespace {

/// For each run of a sweep, by name, the number of its chain; chains are numbered in the order of
/// their first runs.
struct Chains {
  std::map<std::string, std::size_t> of;
  std::size_t count = 0;
};

/// In a manifest a parent comes before its children.
Chains chains_in(const io::Manifest& manifest) {
  Chains chains;
  for (const io::ManifestPoint& point : manifest.points) {
    if (chains.of.contains(point.name)) continue;
    const auto parent = chains.of.find(point.parent);
    chains.of.emplace(point.name, parent == chains.of.end() ? chains.count++ : parent->second);
  }
  return chains;
}

}  // namespace

std::size_t most_parts(const io::Manifest& manifest) { return chains_in(manifest).count; }

std::vector<std::vector<std::string>> parts_of(const io::Manifest& manifest, std::size_t count) {
  const Chains chains = chains_in(manifest);
  std::vector<std::vector<std::string>> parts(count);
  std::set<std::string> seen;
  for (const io::ManifestPoint& point : manifest.points)
    if (seen.insert(point.name).second)
      parts[chains.of.at(point.name) % count].push_back(point.name);
  return parts;
}

}  // namespace riesel::app
