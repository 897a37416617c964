#include "io/run_reader.hpp"

#include "engine/state_check.hpp"
#include "io/file_error.hpp"
#include "io/sealed_hdf5.hpp"
#include "io/state_columns.hpp"
#include "io/state_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace riesel::io {
namespace {

/// In the order of a report. Texts of whole files (settings, source) are left out.
constexpr auto told_of_provenance = {
    "date",         "command",        "continues",    "threads",
    "seed",         "riesel_version", "git_commit",   "git_dirty",
    "compiler",     "flags",          "build_type",   "cpu",
    "host",         "slurm_job_id",   "hdf5_version", "yaml_cpp_version",
    "eigen_version"};

/// The parts of the stress, by what carries them, are left out: the report does not show them.
constexpr auto told_of_profiles = {"area_fraction", "mean_axial_velocity", "temperature_x",
                                   "temperature_y", "stress_xx",           "stress_xy",
                                   "stress_yy"};
/// Runs of riesel 0.13 and before lack them.
constexpr auto told_of_spins = {"mean_spin", "rotational_temperature"};

constexpr auto told_of_histograms = {"grain_contact_duration", "wall_contact_duration",
                                     "grain_contact_overlap", "wall_contact_overlap"};

std::vector<double> read_numbers(const StoredGroup& group, const std::string& name) {
  std::vector<double> values;
  read_column(group, name, values);
  return values;
}

/// Rows of two components, x and y by turns.
std::vector<double> read_pairs(const StoredGroup& group, const std::string& name,
                               std::size_t rows) {
  const auto data = group.data(name);
  require(data.shape().columns == 2 && data.shape().rows == rows,
          "the data set " + name + " is not as long as the others");
  std::vector<double> values(2 * rows);
  data.read(std::span(values));
  return values;
}

std::vector<Grain> read_grains(const StoredGroup& group) {
  const auto radius = read_numbers(group, "radius");
  const auto mass = read_numbers(group, "mass");
  require(mass.size() == radius.size(), "masses and radii differ in number");
  const auto position = read_pairs(group, "position", radius.size());
  const auto velocity = read_pairs(group, "velocity", radius.size());
  std::vector<Grain> grains;
  for (std::size_t i = 0; i < radius.size(); ++i)
    grains.push_back({.x = position[2 * i],
                      .y = position[2 * i + 1],
                      .vx = velocity[2 * i],
                      .vy = velocity[2 * i + 1],
                      .radius = radius[i],
                      .mass = mass[i]});
  return grains;
}

/// N, absolute values; empty in files of riesel before 0.16, which have none.
std::vector<double> read_forces(const StoredGroup& contacts, std::size_t rows) {
  if (!contacts.has("force")) return {};
  const auto pairs = read_pairs(contacts, "force", rows);
  std::vector<double> forces;
  for (std::size_t i = 0; i < rows; ++i)
    forces.push_back(std::hypot(pairs[2 * i], pairs[2 * i + 1]));
  return forces;
}

bool is_sound(const Grain& grain, const Box& box) {
  return std::isfinite(grain.x) && 0.0 <= grain.y && grain.y <= box.length
         && std::isfinite(grain.vx) && std::isfinite(grain.vy) && is_positive(grain.radius);
}

bool is_sound(const WallLattice& wall, const Box& box, double time) {
  const WallWay way = wall.motion.way(box, time);
  return std::isfinite(wall.line) && wall.sound() && std::isfinite(way.x) && std::isfinite(way.y);
}

void check(const FinalState& state) {
  require(is_positive(state.box.width) && is_positive(state.box.length), "the box has no size");
  require(!state.grains.empty(), "there are no grains");
  require(std::isfinite(state.time), "its time is not finite");
  require(std::ranges::all_of(state.grains, [&](const Grain& g) { return is_sound(g, state.box); }),
          "a grain has impossible values");
  require(state.walls.size() <= WallImpulses::most_walls
              && std::ranges::all_of(
                  state.walls,
                  [&](const WallLattice& w) { return is_sound(w, state.box, state.time); }),
          "a wall has impossible values");
  require(std::ranges::all_of(state.contacts,
                              [&](const ContactName& c) {
                                return names_bodies(c, state.grains.size(), state.walls);
                              }),
          "a contact names bodies that are not there");
}

FinalState read_final_state(const StoredGroup& group) {
  FinalState state{.box = {.width = group.attribute<double>("box_width"),
                           .length = group.attribute<double>("box_length")},
                   .time = group.attribute<double>("time"),
                   .step = group.attribute<std::int64_t>("step"),
                   .grains = read_grains(group),
                   .walls = read_records<WallLattice>(group.group("walls")),
                   .contacts = read_records<ContactName>(group.group("contacts")),
                   .forces = {}};
  state.forces = read_forces(group.group("contacts"), state.contacts.size());
  check(state);
  return state;
}

std::vector<Series> read_series(const StoredGroup& group) {
  std::vector<Series> series;
  std::istringstream names(group.text_attribute("columns"));
  for (std::string name; std::getline(names, name, ',');) {
    const auto data = group.data(name);
    series.push_back({.column = {.name = name,
                                 .unit = data.text_attribute("unit"),
                                 .doc = data.text_attribute("doc")},
                      .values = read_numbers(group, name)});
    require(series.back().values.size() == series.front().values.size(),
            "the series " + name + " is not as long as the others");
  }
  return series;
}

Profiles read_profiles(const StoredGroup& group) {
  Profiles profiles{.x = read_numbers(group, "x"), .quantities = {}};
  std::vector<std::string> names(told_of_profiles.begin(), told_of_profiles.end());
  std::ranges::copy_if(told_of_spins, std::back_inserter(names),
                       [&](const char* name) { return group.has(name); });
  for (const std::string& name : names) {
    const auto data = group.data(name);
    profiles.quantities.push_back({.column = {.name = name,
                                              .unit = data.text_attribute("unit"),
                                              .doc = data.text_attribute("doc")},
                                   .values = read_numbers(group, name),
                                   .errors = read_numbers(group, name + "_error")});
    const auto& read = profiles.quantities.back();
    require(read.values.size() == profiles.x.size() && read.errors.size() == profiles.x.size(),
            fmt::format("the profile {} has another number of strips than the others", name));
  }
  return profiles;
}

std::vector<HistogramWithErrors> read_histograms(const StoredGroup& all) {
  std::vector<HistogramWithErrors> histograms;
  for (const char* name : told_of_histograms) {
    const auto group = all.group(name);
    histograms.push_back({.column = {.name = name,
                                     .unit = group.data("lower_edge").text_attribute("unit"),
                                     .doc = group.text_attribute("doc")},
                          .lower_edges = read_numbers(group, "lower_edge"),
                          .rates = read_numbers(group, "rate"),
                          .errors = read_numbers(group, "rate_error")});
    const auto& read = histograms.back();
    const auto& edges = read.lower_edges;
    require(edges.size() > 1 && edges.size() == read.rates.size()
                && edges.size() == read.errors.size() && edges.front() > 0.0
                && std::ranges::is_sorted(edges),
            fmt::format("the histogram {} has impossible bins", name));
  }
  return histograms;
}

Provenance read_provenance(const StoredGroup& group) {
  Provenance provenance;
  for (const char* name : told_of_provenance)
    if (group.has(name)) provenance.emplace_back(name, group.text(name));
  return provenance;
}

RunHistory read_history(const StoredGroup& root) {
  require(root.text_attribute("format") == "riesel run", "it is not a run of riesel");
  const auto provenance = root.group("provenance");
  RunHistory history{.start = read_provenance(provenance), .resumes = {}};
  for (int i = 1; provenance.has(fmt::format("resume_{}", i)); ++i)
    history.resumes.push_back(read_provenance(provenance.group(fmt::format("resume_{}", i))));
  return history;
}

RunContents read_contents(const StoredGroup& root) {
  RunHistory history = read_history(root);
  require(root.has("final"), "it holds no final state");
  require(root.has("profiles"), "it holds no profiles");
  require(root.has("histograms"), "it holds no histograms");
  return {.final_state = read_final_state(root.group("final")),
          .series = read_series(root.group("series")),
          .profiles = read_profiles(root.group("profiles")),
          .histograms = read_histograms(root.group("histograms")),
          .history = std::move(history)};
}

template <class Named>
const Named& find(const std::vector<Named>& all, const std::string& name, const char* kind) {
  const auto found =
      std::ranges::find_if(all, [&](const Named& one) { return one.column.name == name; });
  if (found == all.end()) throw std::out_of_range(fmt::format("there is no {} {}", kind, name));
  return *found;
}

/// The version of riesel that began the run; empty if the file does not say.
std::string version_in(const StoredGroup& root) {
  constexpr auto name = "riesel_version";
  if (!root.has("provenance")) return "";
  const auto provenance = root.group("provenance");
  return provenance.has(name) ? provenance.text(name) : "";
}

/// Calls `read` with the root of a file whose seal is right: what does not fit then may be of
/// another version.
template <class Read>
auto read_sealed(const std::filesystem::path& path, const StoredGroup& root, Read read) {
  try {
    return read(root);
  } catch (const Hdf5Error& error) {
    reject_another_version(path, error.what(), version_in(root));
    throw;
  }
}

/// Calls `read` with the root of the file and returns its result.
template <class Read>
auto read_file(const std::filesystem::path& path, Read read) {
  try {
    return read_sealed(path, open_sealed_hdf5(path, run_file_kind), read);
  } catch (const Hdf5Error& error) {
    throw FileError(path,
                    fmt::format("is damaged, or belongs to another kind of run ({})", error.what()),
                    "restore the file, or make the run again");
  }
}

}  // namespace

double FinalState::mean_diameter() const {
  double sum = 0.0;
  for (const Grain& grain : grains) sum += 2.0 * grain.radius;
  return sum / static_cast<double>(grains.size());
}

const Series& RunContents::series_of(const std::string& name) const {
  return find(series, name, "series");
}

const HistogramWithErrors& RunContents::histogram_of(const std::string& name) const {
  return find(histograms, name, "histogram");
}

bool Profiles::have_spins() const {
  const auto found =
      std::ranges::find(quantities, "rotational_temperature",
                        [](const ProfileWithErrors& profile) { return profile.column.name; });
  return found != quantities.end()
         && std::ranges::any_of(found->values, [](double value) { return value > 0.0; });
}

const ProfileWithErrors& Profiles::named(const std::string& name) const {
  return find(quantities, name, "profile");
}

RunContents read_run_file(const std::filesystem::path& path) {
  return read_file(path, read_contents);
}

RunHistory read_run_history(const std::filesystem::path& path) {
  return read_file(path, read_history);
}

}  // namespace riesel::io
