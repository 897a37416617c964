#include "io/run_file.hpp"

#include "io/file_error.hpp"
#include "io/seal.hpp"
#include "io/sealed_hdf5.hpp"
#include "io/state_columns.hpp"
#include "io/state_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace riesel::io {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t format_version = 1;
constexpr std::size_t buffered_rows = 1024;

std::string names_of(const std::vector<Column>& columns) {
  std::string names;
  for (const auto& column : columns) names += (names.empty() ? "" : ",") + column.name;
  return names;
}

void write_provenance(Hdf5Group group, const Provenance& provenance) {
  for (const auto& [name, value] : provenance) group.write_text(name, value);
}

void record_resume(Hdf5Group& group, const Provenance& provenance) {
  int number = 1;
  while (group.has(fmt::format("resume_{}", number))) ++number;
  write_provenance(group.create_group(fmt::format("resume_{}", number)), provenance);
}

void copy_texts(const StoredGroup& from, Hdf5Group& to) {
  for (const auto& name : from.names())
    if (!from.is_group(name)) to.write_text(name, from.text(name));
}

/// The texts of the start, and those of each resume, which are in groups of their own. (No deeper:
/// a damaged group may contain itself.)
void copy_history(const StoredGroup& from, Hdf5Group& to) {
  copy_texts(from, to);
  for (const auto& name : from.names()) {
    if (!from.is_group(name)) continue;
    auto part = to.create_group(name);
    copy_texts(from.group(name), part);
  }
}

std::vector<double> values_of(const Hdf5Data& data) {
  std::vector<double> values(data.shape().rows);
  data.read(std::span(values));
  return values;
}

void describe(Hdf5Data& data, const Column& column) {
  data.set_attribute("unit", column.unit);
  data.set_attribute("doc", column.doc);
}

void check_row(std::size_t size, std::size_t columns) {
  if (size == columns) return;
  throw std::invalid_argument(fmt::format("a row of {} values for {} columns", size, columns));
}

Hdf5Group replace_group(Hdf5Group parent, const std::string& name) {
  if (parent.has(name)) parent.remove(name);
  return parent.create_group(name);
}

void write_grains(Hdf5Group& group, const State& state) {
  const auto slots = slots_by_id(state.grains);
  std::vector<double> position, velocity, radius, mass, spin;
  std::vector<std::int32_t> id;
  const GrainView grains(state);
  for (const auto slot : slots) {
    const Grain grain = grains[slot];
    position.insert(position.end(), {grain.x, grain.y});
    velocity.insert(velocity.end(), {grain.vx, grain.vy});
    radius.push_back(grain.radius);
    mass.push_back(grain.mass);
    spin.push_back(grain.spin);
    id.push_back(state.grains.id[slot]);
  }
  write_column<double>(group, "position", "m", position, 2);
  write_column<double>(group, "velocity", "m/s", velocity, 2);
  write_column<double>(group, "radius", "m", radius);
  write_column<double>(group, "mass", "kg", mass);
  write_column<std::int32_t>(group, "id", "1", id);
  if (state.grains.rotate()) write_column<double>(group, "spin", "rad/s", spin);
}

void write_forces(Hdf5Group& contacts, std::span<const PresentForce> forces) {
  std::vector<double> pairs;
  for (const PresentForce& force : forces) pairs.insert(pairs.end(), {force.fx, force.fy});
  write_column<double>(contacts, "force", "N", pairs, 2)
      .set_attribute("doc", "On the grain that names the contact, friction included.");
}

void write_window(Hdf5Group& group, const Window& window) {
  group.set_attribute("since", window.since);
  group.set_attribute("state", name(window.state));
}

void write_profile(Hdf5Group& group, const TubeProfile& profile) {
  const std::string name(profile.name), unit(profile.unit);
  std::vector<double> values, errors;
  for (const Estimate& strip : profile.zones) {
    values.push_back(strip.value);
    errors.push_back(strip.error);
  }
  write_column<double>(group, name, unit, values).set_attribute("doc", profile.meaning);
  write_column<double>(group, name + "_error", unit, errors)
      .set_attribute("doc", "68 % error of " + name + ".");
}

void write_histogram(Hdf5Group& parent, const HistogramTable& histogram) {
  auto group = parent.create_group(std::string(histogram.name));
  group.set_attribute("doc", histogram.meaning);
  std::vector<double> rates, errors;
  for (const Estimate& rate : histogram.rates) {
    rates.push_back(rate.value);
    errors.push_back(rate.error);
  }
  write_column<double>(group, "lower_edge", std::string(histogram.unit), histogram.lower_edges);
  write_column<std::int64_t>(group, "count", "1", histogram.counts)
      .set_attribute("doc", "How many ended since the start.");
  write_column<double>(group, "rate", "1/s", rates)
      .set_attribute("doc", "How many ended per second after the transient.");
  write_column<double>(group, "rate_error", "1/s", errors)
      .set_attribute("doc", "68 % error of rate.");
}

void write_walls(Hdf5Group group, const State& state) {
  write_records(group, state.walls);
  std::vector<double> spacing;
  spacing.reserve(state.walls.size());
  for (const auto& wall : state.walls) spacing.push_back(wall.spacing(state.box));
  write_column<double>(group, "spacing", "m", spacing);
}

/// Identifies the run of a provenance, the same after a resume; empty if it cannot be resumed.
std::string run_of(const Provenance& provenance) {
  const auto found = std::ranges::find(provenance, run_key, &Provenance::value_type::first);
  return found == provenance.end() ? "" : found->second;
}

void require_same_run(const StoredGroup& old, const Provenance& provenance) {
  if (old.text(run_key) != run_of(provenance)) throw Hdf5Error("it belongs to another run");
}

}  // namespace

/// The file in memory, and the rows that it does not contain yet.
class RunFile::Contents {
public:
  Contents(fs::path path, std::vector<Column> columns)
      : path_(std::move(path)), columns_(std::move(columns)), buffers_(columns_.size()) {
    root().set_attribute("format", "riesel run");
    root().set_attribute("format_version", format_version);
    create_series();
  }

  Hdf5Group root() const { return file_.root(); }
  std::int64_t rows() const { return rows_; }

  /// Copies the first rows of the series of another file. Throws Hdf5Error if they do not fit.
  void take_rows(const StoredGroup& from, std::int64_t rows) {
    if (const auto found = from.text_attribute("columns"); found != names_of(columns_)) {
      throw Hdf5Error(fmt::format("its series are {} instead of {}", found, names_of(columns_)));
    }
    rows_ = rows;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      std::vector<double> values;
      read_column(from, columns_[i].name, values);
      const auto wanted = static_cast<std::size_t>(rows);
      if (values.size() < wanted) {
        throw Hdf5Error(fmt::format("it has {} rows of {}, but the checkpoint expects {}",
                                    values.size(), columns_[i].name, rows));
      }
      series_[i].append(std::span<const double>(values).first(wanted));
    }
  }

  void append(std::span<const double> row) {
    check_row(row.size(), columns_.size());
    for (std::size_t i = 0; i < row.size(); ++i) buffers_[i].push_back(row[i]);
    ++rows_;
    if (!buffers_.empty() && buffers_.front().size() == buffered_rows) empty_buffers();
  }

  std::vector<double> series(std::string_view name) {
    empty_buffers();
    return values_of(root().group("series").data(std::string(name)));
  }

  void flush() {
    empty_buffers();
    write_sealed_hdf5(path_, file_, run_file_kind, Previous::discard);
  }

private:
  void create_series() {
    auto group = root().create_group("series");
    group.set_attribute("columns", names_of(columns_));
    for (const auto& column : columns_) {
      series_.push_back(group.create_data<double>(column.name, {.growing = true}));
      describe(series_.back(), column);
    }
  }

  void empty_buffers() {
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
      series_[i].append(std::span<const double>(buffers_[i]));
      buffers_[i].clear();
    }
  }

  fs::path path_;
  Hdf5File file_ = Hdf5File::create(seal_size);
  std::vector<Column> columns_;
  std::vector<Hdf5Data> series_;
  std::vector<std::vector<double>> buffers_;
  std::int64_t rows_ = 0;
};

RunFile::RunFile(const fs::path& path, const std::vector<Column>& series)
    : contents_(std::make_unique<Contents>(path, series)) {}
RunFile::~RunFile() = default;
RunFile::RunFile(RunFile&&) noexcept = default;
RunFile& RunFile::operator=(RunFile&&) noexcept = default;

RunFile RunFile::create(const fs::path& path, const Provenance& provenance,
                        const std::vector<Column>& series) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(path, ignored))) {
    throw FileError(path, "exists already", "choose another directory, or resume that run");
  }
  RunFile file(path, series);
  write_provenance(file.contents_->root().create_group("provenance"), provenance);
  return file;
}

RunFile RunFile::reopen(const fs::path& path, const Provenance& provenance,
                        const std::vector<Column>& series, std::int64_t rows) {
  try {
    const auto old = open_sealed_hdf5(path, run_file_kind);
    require_same_run(old.group("provenance"), provenance);
    RunFile file(path, series);
    file.contents_->take_rows(old.group("series"), rows);
    auto root = file.contents_->root();
    auto history = root.create_group("provenance");
    copy_history(old.group("provenance"), history);
    record_resume(history, provenance);
    return file;
  } catch (const Hdf5Error& error) {
    throw FileError(path, fmt::format("does not fit the checkpoint ({})", error.what()),
                    "restore the file that belongs to it, or start the run again");
  }
}

void RunFile::append(std::span<const double> row) { contents_->append(row); }

std::int64_t RunFile::rows() const { return contents_->rows(); }

std::vector<double> RunFile::series(std::string_view name) const { return contents_->series(name); }

void RunFile::write_final_state(const State& state, std::span<const PresentForce> forces) {
  if (forces.size() != state.contacts.size())
    throw std::invalid_argument("a final state needs one force for each contact");
  auto group = replace_group(contents_->root(), "final");
  for_each_scalar(state, [&](const char* name, auto value) { group.set_attribute(name, value); });
  group.set_attribute("time", state.time());
  write_grains(group, state);
  write_walls(group.create_group("walls"), state);
  auto contacts = group.create_group("contacts");
  write_records(contacts, state.contacts);
  write_forces(contacts, forces);
}

void RunFile::write_profiles(const Strips& strips, const std::vector<TubeProfile>& profiles,
                             const Window& window) {
  auto group = replace_group(contents_->root(), "profiles");
  write_window(group, window);
  group.set_attribute("strip_width", strips.width);
  write_column<double>(group, "x", "m", strips.middles())
      .set_attribute("doc", "Middle of the strip; the wall lines are at 0 and at the width.");
  for (const TubeProfile& profile : profiles) write_profile(group, profile);
}

void RunFile::write_histograms(const std::vector<HistogramTable>& histograms,
                               const Window& window) {
  auto group = replace_group(contents_->root(), "histograms");
  write_window(group, window);
  for (const HistogramTable& histogram : histograms) write_histogram(group, histogram);
}

void RunFile::write_validity(const ValidityVerdict& validity) {
  auto group = replace_group(contents_->root(), "validity");
  group.set_attribute("verdict", name(validity.verdict));
  for (const Finding& finding : validity.findings)
    group.set_attribute(std::string(finding.name), finding.value);
}

void RunFile::write_curve(const std::vector<Column>& columns,
                          const std::vector<std::vector<double>>& rows) {
  for (const auto& row : rows) check_row(row.size(), columns.size());
  auto group = replace_group(contents_->root(), "curve");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const auto& row : rows) values.push_back(row[i]);
    auto data = write_column<double>(group, columns[i].name, columns[i].unit, values);
    data.set_attribute("doc", columns[i].doc);
  }
}

void RunFile::flush() { contents_->flush(); }

}  // namespace riesel::io
