// Rates and ratios from series that accumulate since the start of a run: what happened after the
// transient, with error bars that take correlations into account.
#pragma once

#include "io/run_file.hpp"
#include "io/summary.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace riesel::app {

/// The rows of a run from row `first` on, which must exist; rows are `interval` (s) apart. `file`
/// must outlive this.
class CumulativeSeries {
public:
  CumulativeSeries(const io::RunFile& file, std::size_t first, double interval)
      : file_(&file), first_(first), interval_(interval) {}

  /// Increase since row `first`.
  double total(const std::string& name) const;
  /// Per second.
  io::Measured rate(const std::string& name) const;
  /// Per second, of rate(one) + factor rate(other).
  double error_of_sum(const std::string& one, const std::string& other, double factor) const;
  /// total(part) / total(whole). NaN if total(whole) is 0.
  double quotient(const std::string& part, const std::string& whole) const;
  /// quotient(part, counted) with its error (error_per_weight). What is counted never falls.
  io::Measured ratio(const std::string& part, const std::string& counted) const;

private:
  std::vector<double> increments(const std::string& name) const;

  const io::RunFile* file_;
  std::size_t first_;
  double interval_;
};

}  // namespace riesel::app
