// riesel collect: the table of a sweep, from the results that there are so far.
#include "app/sweep_collect.hpp"

#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/print_sweep.hpp"
#include "app/sweep_directory.hpp"
#include "app/terminal.hpp"
#include "io/directory_lock.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/settings_text.hpp"
#include "io/summary.hpp"
#include "io/summary_units.hpp"
#include "io/sweep_table.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

/// The texts that a sweep may have at its points; those that it has nowhere get no column.
constexpr std::array<std::pair<const char*, std::string io::ManifestPoint::*>, 3> texts = {
    {{"branch", &io::ManifestPoint::branch},
     {"leg", &io::ManifestPoint::leg},
     {"parent", &io::ManifestPoint::parent}}};

/// For each of `texts`, whether any point has it.
std::array<bool, texts.size()> texts_of(const io::Manifest& manifest) {
  std::array<bool, texts.size()> any{};
  for (std::size_t i = 0; i < texts.size(); ++i)
    any[i] = std::ranges::any_of(
        manifest.points, [&](const auto& point) { return !(point.*texts[i].second).empty(); });
  return any;
}

void add_plan(const io::Manifest& manifest, const std::array<bool, texts.size()>& has_text,
              std::size_t row, io::SweepTable& table) {
  const io::ManifestPoint& point = manifest.points[row];
  table.set(row, "point", point.name);
  for (std::size_t i = 0; i < manifest.varied.size(); ++i)
    table.set(row, manifest.varied[i].key, point.values[i], manifest.varied[i].unit);
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (has_text[i]) table.set(row, texts[i].first, point.*texts[i].second);
  table.set(row, "status", point.status);
  table.set(row, "attempts", static_cast<double>(point.attempts));
  table.set(row, "reason", point.reason);
}

/// A result with the same name as a column of the plan (such as seed) gets a prefix.
void add_results(const fs::path& summary, std::size_t row, std::size_t columns_of_plan,
                 io::SweepTable& table) {
  for (auto& [name, value] : io::flat_summary(summary)) {
    const auto plan_end = table.columns().begin() + static_cast<std::ptrdiff_t>(columns_of_plan);
    const bool taken = std::any_of(table.columns().begin(), plan_end,
                                   [&, &n = name](auto& column) { return column.name == n; });
    table.set(row, taken ? "summary." + name : name, std::move(value), io::unit_of_result(name));
  }
}

/// Tasks leave the manifest as it is. A process that runs the whole sweep writes it itself, and
/// another plan may have come meanwhile.
void keep(const io::Manifest& manifest, const fs::path& sweep) {
  try {
    const io::DirectoryLock lock(sweep);
    const io::Manifest now = io::read_manifest(sweep);
    if (std::ranges::equal(now.points, manifest.points, {}, &io::ManifestPoint::name,
                           &io::ManifestPoint::name))
      io::write_durably(sweep / io::manifest_name, io::to_json(manifest));
  } catch (const io::InUse&) {
  }
}

/// Refreshes the manifest; returns whether any status was another one before.
bool has_changed(io::Manifest& manifest, const fs::path& sweep) {
  const io::Manifest before = manifest;
  refresh(manifest, sweep);
  return !std::ranges::equal(before.points, manifest.points, {}, &io::ManifestPoint::status,
                             &io::ManifestPoint::status);
}

}  // namespace

bool write_table(io::Manifest& manifest, const fs::path& sweep) {
  const std::string sweep_file = io::read_kept_text(sweep / sweep_file_name);
  const std::set<std::string> misplaced = note_misplaced(manifest, sweep);
  bool all_taken = misplaced.empty();
  io::SweepTable table(manifest.points.size());
  const auto has_text = texts_of(manifest);
  for (std::size_t row = 0; row < table.rows(); ++row) add_plan(manifest, has_text, row, table);
  const std::size_t columns_of_plan = table.columns().size();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const io::ManifestPoint& point = manifest.points[row];
    const fs::path directory = point_directory(sweep, point.name);
    const bool in_reach = obstacle_at(directory).empty();
    all_taken = all_taken && in_reach;
    if (!in_reach || misplaced.contains(point.name)) continue;
    const fs::path summary = summary_of(directory);  // whatever the status
    if (!fs::exists(summary)) continue;
    try {
      add_results(summary, row, columns_of_plan, table);
    } catch (const io::FileError& error) {  // go on with the other points
      all_taken = false;
      table.set(row, "reason", std::string(error.what()));
      tell("riesel: {}\n", error.what());
    }
  }
  io::write_durably(sweep / io::sweep_csv_name, io::to_csv(table));
  io::write_hdf5(sweep / io::sweep_h5_name, table, sweep_file);
  return all_taken;
}

int sweep_collect(const fs::path& directory) {
  io::Manifest manifest = manifest_in(directory);
  refresh(manifest, directory);
  // A sweep that ends meanwhile writes its last table, which this one may replace by an older one.
  constexpr int most_tables = 5;  // beside a sweep that goes on, which will write another
  const bool beside_a_sweep = io::DirectoryLock::is_held(directory);
  bool all_taken = write_table(manifest, directory);
  for (int i = 1; beside_a_sweep && i < most_tables && has_changed(manifest, directory); ++i)
    all_taken = write_table(manifest, directory);
  keep(manifest, directory);
  print_status(manifest, directory);
  return all_taken ? exit_done : exit_failed;
}

}  // namespace riesel::app
