// Rates and ratios from series that count since the start of a run: what happened after the
// transient, with error bars that know of correlations.
#pragma once

#include "io/run_file.hpp"
#include "io/summary.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace riesel::app {

/// The rows of a run from row `first` on, which is one of them; `interval` (s) lies between two.
class CumulativeSeries {
public:
  CumulativeSeries(const io::RunFile& file, std::size_t first, double interval)
      : file_(&file), first_(first), interval_(interval) {}

  /// What came since row `first`.
  double total(const std::string& name) const;
  /// Per second.
  io::Measured rate(const std::string& name) const;
  /// One total over the other; the error is that of a ratio estimator. Not a number if nothing came
  /// of the second.
  io::Measured ratio(const std::string& part, const std::string& whole) const;

private:
  std::vector<double> increments(const std::string& name) const;

  const io::RunFile* file_;
  std::size_t first_;
  double interval_;
};

}  // namespace riesel::app
