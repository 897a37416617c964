// Whether a flow is steady, and as precise as it was asked to be, by its series so far.
#pragma once

#include "engine/state.hpp"
#include "engine/steady_state.hpp"
#include "io/run_file.hpp"
#include "io/summary.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace riesel::app {

/// The names of the series by which a flow is judged steady (FlowSeries): its mean axial velocity
/// and its granular temperature, the latter first if gravity does not drive it along the walls; and
/// its rotational temperature, if grains rotate.
struct Judged {
  io::JudgedBy series;
  std::vector<io::JudgedBy> others;
  std::optional<double> free_fall_gain;  ///< m/s per row, of free fall; see assess_steady_state()
};

/// `interval`: s, between two rows.
Judged judged_by(const State& state, double interval);

class Steadiness {
public:
  /// `record` must outlive this. `relative_error`: of the judged mean, if the run asks for one.
  Steadiness(const io::RunFile& record, Judged by, std::optional<double> relative_error)
      : record_(&record), by_(std::move(by)), relative_error_(relative_error) {}

  SteadyState state() const;

  /// Whether the rows so far are as many as are looked at, for a run that asks for precision.
  bool is_looked_at() const;
  /// Whether the run may end with its last row, as precise as it was asked to be.
  bool is_precise_enough() const;

private:
  template <class By>
  auto judge(By by) const;

  const io::RunFile* record_;
  Judged by_;
  std::optional<double> relative_error_;
};

}  // namespace riesel::app
