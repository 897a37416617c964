#include "app/commands.hpp"
#include "app/plain_words.hpp"
#include "app/resumed_settings.hpp"
#include "app/run_flow.hpp"
#include "app/terminal.hpp"
#include "engine/histogram_blocks.hpp"
#include "engine/strips.hpp"
#include "io/checkpoint.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/run_file.hpp"
#include "io/trajectory_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace riesel::app {

namespace {

bool is_another_file_of_a_run(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 5> of_texts = {".yaml", ".json", ".html", ".txt", ".csv"};
  const std::string name = path.filename().string();
  return std::ranges::find(of_texts, path.extension().string()) != of_texts.end()
         || name == io::run_file_name || name == io::trajectory_name || name == io::lock_name;
}

void reject_what_is_no_run(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path))
    throw UnusableInput(path.string() + ": does not exist; check the path");
  const auto post_mortem = path / post_mortem_name;
  const auto holder = io::DirectoryLock::holder(path);
  if (holder && has_only_begun(path))
    throw UnusableInput(path.string() + ": " + io::in_use_by + *holder + "; wait until that ends");
  if (has_only_begun(path))
    throw UnusableInput(path.string()
                        + ": was stopped before its first checkpoint; remove it and start the run "
                          "again"
                        + (std::filesystem::exists(post_mortem)
                               ? ", or go on from " + post_mortem.string() + " with another limit"
                               : ""));
  if (std::filesystem::exists(path / io::manifest_name))
    throw UnusableInput(path.string() + ": holds a sweep; go on with it by '"
                        + call_of("sweep", path) + "'");
  if (std::filesystem::is_regular_file(path) && is_another_file_of_a_run(path))
    throw UnusableInput(path.string() + ": is no checkpoint; give the directory of a run, or its "
                        + io::checkpoint_name);
  if (std::filesystem::is_directory(path) && !has_checkpoint(path))
    throw UnusableInput(
        path.string()
        + ": holds no run of a flow to go on with; give the directory of one "
          "(curves of impacts and columns of beads are not resumed: run them again)");
}

/// Whether it is one of the two generations between which a run that goes on may choose.
bool is_own_generation(const std::filesystem::path& checkpoint) {
  const auto name = checkpoint.filename();
  return name == io::checkpoint_name || name == io::previous_generation(io::checkpoint_name);
}

/// Throws UnusableInput for a copy of an earlier checkpoint in a directory whose run has gone on
/// since: going on from there would put the later result out of the way.
void reject_what_the_run_has_passed(const io::FoundCheckpoint& found,
                                    const std::filesystem::path& home) {
  if (is_own_generation(found.path) || !has_checkpoint(home)) return;
  try {
    const io::Checkpoint own = io::find_checkpoint(home).checkpoint;
    if (own.run != found.checkpoint.run || own.state.step <= found.checkpoint.state.step) return;
    throw UnusableInput(fmt::format("{}: is at {:.6g} s, and the run in {} has come to {:.6g} s "
                                    "already; to go back, copy the directory, and put this file in "
                                    "the place of {} there",
                                    found.path.string(), found.checkpoint.state.time(),
                                    home.string(), own.state.time(), io::checkpoint_name));
  } catch (const io::FileError&) {  // there is nothing to go on from but the file that was given
  }
}

std::filesystem::path home_of(const std::filesystem::path& checkpoint) {
  return std::filesystem::is_directory(checkpoint)
             ? checkpoint
             : std::filesystem::absolute(checkpoint).parent_path();
}

}  // namespace

int resume(const ResumeOptions& options, const Arguments& arguments) {
  reject_overrides_of_the_physics(options.overrides);
  reject_what_is_no_run(options.checkpoint);
  // From here on the directory is locked, so that no other process changes what is read.
  RunDirectory directory = RunDirectory::reopen(home_of(options.checkpoint));
  io::FoundCheckpoint found = as_input([&] { return io::find_checkpoint(options.checkpoint); });
  reject_what_the_run_has_passed(found, directory.path());
  if (!found.note.empty()) tell("riesel: {}; going on from {}\n", found.note, found.path.string());

  const io::Settings settings =
      resumed_settings(found.checkpoint.settings, found.path.string(), options.overrides);
  const State& state = found.checkpoint.state;
  const scenarios::RunLength length = resumed_length(settings, state);
  if (length.at_most < state.time() - state.time_step)
    settings.reject(length.key, fmt::format("the run has come to {:.6g} s already", state.time()),
                    "choose a longer time");
  const auto damaged = [&](const std::string& flaw) {
    return UnusableInput(found.path.string() + ": is damaged (" + flaw + "); start the run again");
  };
  if (found.checkpoint.rows > 0) {
    if (const std::string& version = found.checkpoint.other_records_by; !version.empty())
      throw UnusableInput(
          fmt::format("{}: has records of other quantities; use riesel {} to go on with "
                      "this run, or start a new one from it (start.kind)",
                      found.path.string(), version));
    if (found.checkpoint.profiles.columns() != Strips::of(state).columns())
      throw damaged("its profiles are not those of this tube");
    if (found.checkpoint.histograms.columns() != HistogramBlocks().blocks().columns())
      throw damaged("its histograms are not those of this version");
  }
  return resume_flow(settings, std::move(found.checkpoint), std::move(directory), arguments,
                     options.flow);
}

}  // namespace riesel::app
