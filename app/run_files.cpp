#include "app/run_files.hpp"

#include "app/commands.hpp"
#include "app/series.hpp"
#include "engine/present_forces.hpp"

#include <utility>

namespace riesel::app {

namespace {

io::RunFile open_record(const RunDirectory& directory, const io::RunOrigin& origin,
                        std::int64_t rows) {
  const io::Provenance provenance = io::collect_provenance(origin);
  const auto path = directory.file(io::run_file_name);
  if (rows == 0) return io::RunFile::create(path, provenance, series_columns());
  return as_input([&] { return io::RunFile::reopen(path, provenance, series_columns(), rows); });
}

io::TrajectoryFile open_trajectory(const RunDirectory& directory, const io::RunOrigin& origin,
                                   std::int64_t rows, const State& state,
                                   std::int64_t steps_per_frame) {
  const auto by = [&](auto open) {
    return open(directory.file(io::trajectory_name), origin.run.value(), state, steps_per_frame,
                origin.settings);
  };
  if (rows == 0) return by(io::TrajectoryFile::create);
  return as_input([&] { return by(io::TrajectoryFile::reopen); });
}

}  // namespace

RunFiles::RunFiles(RunDirectory directory, const io::RunOrigin& origin, std::int64_t rows,
                   const State& state, std::int64_t steps_per_frame)
    : directory_(std::move(directory)), record_(open_record(directory_, origin, rows)) {
  if (steps_per_frame > 0)
    trajectory_ = open_trajectory(directory_, origin, rows, state, steps_per_frame);
}

void RunFiles::add_frame(const State& state) {
  if (trajectory_) trajectory_->append(state);
}

void RunFiles::flush(const State& state, const ContactModel& model) {
  directory_.require_in_place();
  record_.write_final_state(state, present_forces(state, model));
  record_.flush();
  if (trajectory_) trajectory_->commit();
}

}  // namespace riesel::app
