#include "io/checkpoint.hpp"

#include "engine/state_check.hpp"
#include "io/build_info.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/seal.hpp"
#include "io/sealed_hdf5.hpp"
#include "io/state_columns.hpp"
#include "io/state_layout.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace riesel::io {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t format_version = 13;
constexpr std::int64_t oldest_version = 10;  // before 12 profiles are of other sums
constexpr std::array since_13 = {"left_x", "right_x"};
constexpr auto kind = "checkpoint";

// --- the parts of the checkpoint, each written and read ---

void write(Hdf5Group group, const Grains& grains, const Box& box) {
  group.set_attribute("quantum_x", box.quantum_x());
  group.set_attribute("quantum_y", box.quantum_y());
  const auto slots = slots_by_id(grains);
  for_each_array(grains, [&](const char* name, const char* unit, const auto& array, auto number) {
    using T = std::remove_cvref_t<decltype(number(array[0]))>;
    std::vector<T> ordered(array.size());
    for (std::size_t i = 0; i < array.size(); ++i) ordered[i] = number(array[slots[i]]);
    write_column<T>(group, name, unit, ordered);
  });
}

void read_grains(const StoredGroup& group, Grains& grains) {
  for_each_array(grains, [&](const char* name, const char*, auto& array, auto number) {
    std::vector<std::remove_cvref_t<decltype(number(array[0]))>> column;
    read_column(group, name, column);
    if (array.empty()) array.resize(column.size());
    if (array.size() != column.size()) refuse_size(name);
    for (std::size_t i = 0; i < column.size(); ++i) number(array[i]) = column[i];
  });
}

template <Hdf5Number T>
void write_value(Hdf5Object& object, const std::string& name, T value) {
  object.set_attribute(name, value);
}

void write_value(Hdf5Object& object, const std::string& name, const ExactSum& sum) {
  object.set_attribute(name + "_high", sum.high());
  object.set_attribute(name + "_low", sum.low());
}

template <std::size_t n>
void write_value(Hdf5Group& group, const std::string& name,
                 const std::array<std::int64_t, n>& counts) {
  write_column<std::int64_t>(group, name, "1", counts);
}

template <Hdf5Number T>
void read_value(const StoredObject& object, const std::string& name, T& value) {
  value = object.attribute<T>(name);
}

void read_value(const StoredObject& object, const std::string& name, ExactSum& sum) {
  sum = ExactSum::from_halves(object.attribute<std::int64_t>(name + "_high"),
                              object.attribute<std::uint64_t>(name + "_low"));
}

template <std::size_t n>
void read_value(const StoredGroup& group, const std::string& name,
                std::array<std::int64_t, n>& counts) {
  std::vector<std::int64_t> values;
  read_column(group, name, values);
  if (values.size() != n) throw Hdf5Error("the data set " + name + " has another length");
  std::copy(values.begin(), values.end(), counts.begin());
}

void write(Hdf5Group group, const Tally& tally) {
  for_each_kind(tally, [&](const char* name_of_kind, const auto& of_kind) {
    auto part = group.create_group(name_of_kind);
    for_each_value(of_kind,
                   [&](const char* name, const auto& value) { write_value(part, name, value); });
  });
}

/// The deepest contacts so far: at most one among grains and one at a wall.
std::vector<Contact> deepest_of(const Tally& tally) {
  std::vector<Contact> contacts;
  for (const ContactTally* contacts_of : {&tally.grains, &tally.walls})
    if (contacts_of->deepest) contacts.push_back(*contacts_of->deepest);
  return contacts;
}

Tally read_tally(const StoredGroup& group, std::int64_t version) {
  Tally tally;
  for_each_kind(tally, [&](const char* name_of_kind, auto& of_kind) {
    const auto part = group.group(name_of_kind);
    for_each_value(of_kind, [&](std::string_view name, auto& value) {
      const bool is_new = std::ranges::find(since_13, name) != since_13.end();
      if (version >= 13 || !is_new) read_value(part, std::string(name), value);
    });
  });
  return tally;
}

void write(Hdf5Group root, const State& state) {
  for_each_scalar(state, [&](const char* name, auto value) { write_value(root, name, value); });
  write(root.create_group("grains"), state.grains, state.box);
  auto walls = root.create_group("walls");
  write_records(walls, state.walls);
  auto contacts = root.create_group("contacts");
  write_records(contacts, state.contacts);
  auto open_visits = root.create_group("open_visits");
  write_records(open_visits, state.open_visits);
  write(root.create_group("tally"), state.tally);
  auto deepest = root.create_group("deepest_contacts");
  write_records(deepest, deepest_of(state.tally));
}

State read_state(const StoredGroup& root) {
  State state;
  for_each_scalar(state, [&](const char* name, auto& value) { read_value(root, name, value); });
  read_grains(root.group("grains"), state.grains);
  state.walls = read_records<WallLattice>(root.group("walls"));
  state.contacts = read_records<Contact>(root.group("contacts"));
  state.open_visits = read_records<WallVisit>(root.group("open_visits"));
  state.tally = read_tally(root.group("tally"), root.attribute<std::int64_t>("format_version"));
  for (const Contact& contact : read_records<Contact>(root.group("deepest_contacts")))
    state.tally.of(contact.name).deepest = contact;
  return state;
}

void write(Hdf5Group group, const TimeBlocks& blocks) {
  group.set_attribute("columns", static_cast<std::int64_t>(blocks.columns()));
  group.set_attribute("samples", blocks.samples());
  group.set_attribute("samples_per_block", blocks.samples_per_block());
  write_column<double>(group, "sums", "SI", blocks.sums());
}

TimeBlocks read_blocks(const StoredGroup& group) {
  std::vector<double> sums;
  read_column(group, "sums", sums);
  try {
    return {static_cast<std::size_t>(group.attribute<std::int64_t>("columns")),
            group.attribute<std::int64_t>("samples"),
            group.attribute<std::int64_t>("samples_per_block"), std::move(sums)};
  } catch (const std::invalid_argument& flaw) {
    throw Hdf5Error(std::string("invalid time blocks: ") + flaw.what());
  }
}

void write(Hdf5Group root, const Checkpoint& checkpoint) {
  root.set_attribute("format", "riesel checkpoint");
  root.set_attribute("format_version", format_version);
  root.set_attribute("riesel_version", build_info().version);
  root.set_attribute("git_commit", build_info().git_commit);
  root.set_attribute("rows", checkpoint.rows);
  root.set_attribute("wall_seconds", checkpoint.wall_seconds);
  root.write_text("settings", checkpoint.settings);
  root.write_text("source", checkpoint.source);
  root.set_attribute("run", checkpoint.run);
  root.write_text("warnings", fmt::format("{}", fmt::join(checkpoint.warnings, "\n")));
  write(root.create_group("profiles"), checkpoint.profiles);
  write(root.create_group("histograms"), checkpoint.histograms);
  write(std::move(root), checkpoint.state);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream rest(text);
  for (std::string line; std::getline(rest, line);) lines.push_back(line);
  return lines;
}

Checkpoint read_contents(const StoredGroup& root) {
  return {.state = read_state(root),
          .settings = root.text("settings"),
          .source = root.text("source"),
          .run = root.attribute<std::uint64_t>("run"),
          .warnings = lines_of(root.text("warnings")),
          .rows = root.attribute<std::int64_t>("rows"),
          .wall_seconds = root.attribute<double>("wall_seconds"),
          .profiles = read_blocks(root.group("profiles")),
          .histograms = read_blocks(root.group("histograms")),
          .other_records_by = root.attribute<std::int64_t>("format_version") == format_version
                                  ? ""
                                  : root.text_attribute("riesel_version")};
}

// --- what can be wrong with it ---

std::string flaw_of(const Checkpoint& checkpoint) {
  if (checkpoint.rows < 0) return "the number of rows is negative";
  if (!(std::isfinite(checkpoint.wall_seconds) && checkpoint.wall_seconds >= 0.0)) {
    return "the wall-clock time is negative or not finite";
  }
  for (const auto& [name, blocks] : {std::pair{"profiles", &checkpoint.profiles},
                                     std::pair{"histograms", &checkpoint.histograms}}) {
    if (!std::ranges::all_of(blocks->sums(), [](double sum) { return std::isfinite(sum); }))
      return "a sum over a block of time is not finite";
    if (blocks->columns() > 0 && blocks->samples() != checkpoint.rows)
      return fmt::format("the {} have {} samples, but there are {} rows", name, blocks->samples(),
                         checkpoint.rows);
  }
  if (checkpoint.state.walls.empty()) return "there are no walls";
  return riesel::flaw_of(checkpoint.state);
}

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

[[noreturn]] void throw_damaged(const fs::path& path, const std::string& flaw) {
  const auto previous = previous_generation(path);
  throw FileError(path, "is damaged (" + flaw + ")",
                  is_there(previous) ? "use " + previous.string() : "start the run again");
}

void check_version(const StoredGroup& root, const fs::path& path) {
  const auto version = root.attribute<std::int64_t>("format_version");
  if (version >= oldest_version && version <= format_version) return;
  throw OtherFormat(path,
                    fmt::format("has format version {}, but this riesel ({}) reads {} to {}",
                                version, build_info().version, oldest_version, format_version),
                    "use riesel " + root.text_attribute("riesel_version"));
}

Checkpoint read_sealed(const fs::path& path) {
  const auto root = open_sealed_hdf5(path, kind);
  check_version(root, path);
  return read_contents(root);
}

}  // namespace

void write_checkpoint(const fs::path& path, const Checkpoint& checkpoint) {
  if (const auto flaw = flaw_of(checkpoint); !flaw.empty()) {
    throw FileError(
        path, "has not been replaced, because the new state could not be continued (" + flaw + ")",
        "check the run: it has diverged");
  }
  auto file = Hdf5File::create(seal_size);
  write(file.root(), checkpoint);
  write_sealed_hdf5(path, file, kind, Previous::keep);
}

Checkpoint read_checkpoint(const fs::path& path) {
  std::string flaw;
  try {
    auto checkpoint = read_sealed(path);
    flaw = flaw_of(checkpoint);
    if (flaw.empty()) return checkpoint;
  } catch (const Hdf5Error& error) {
    flaw = error.what();
  }
  throw_damaged(path, flaw);
}

FoundCheckpoint find_checkpoint(const fs::path& path) {
  std::error_code ignored;
  const auto newest = fs::is_directory(path, ignored) ? path / checkpoint_name : path;
  const auto previous = previous_generation(newest);
  try {
    return {.checkpoint = read_checkpoint(newest), .path = newest, .note = {}};
  } catch (const OtherFormat&) {  // of a later riesel: the state before is out of date
    throw;
  } catch (const FileError& error) {
    if (!is_there(previous)) throw;
    const auto note = newest.string() + ": " + error.problem();
    try {
      return {.checkpoint = read_checkpoint(previous), .path = previous, .note = note};
    } catch (const FileError& older) {
      throw FileError(newest, error.problem() + "; " + previous.string() + ": " + older.problem(),
                      older.remedy());
    }
  }
}

}  // namespace riesel::io
