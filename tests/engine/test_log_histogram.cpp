#include "engine/log_histogram.hpp"
#include "tests/catch.hpp"

#include <cmath>

using Binned = riesel::LogHistogram<-30>;

TEST_CASE("a value falls into the bin that begins at or below it") {
  for (double value = 1.3e-9; value < 0.2; value *= 1.013) {
    Binned histogram;
    histogram.add(value);
    const double edge = histogram.quantile(0.5);
    CHECK(edge <= value);
    CHECK(value < 1.25 * edge);
  }
}

TEST_CASE("the bins are quarters of an octave, one after the other") {
  CHECK(Binned::lower_edge(0) == 0x1p-30);
  CHECK(Binned::lower_edge(3) == 1.75 * 0x1p-30);
  CHECK(Binned::lower_edge(4) == 0x1p-29);
  for (std::size_t bin = 0; bin + 1 < Binned::bins; ++bin) {
    Binned histogram;
    histogram.add(Binned::lower_edge(bin));
    histogram.add(std::nextafter(Binned::lower_edge(bin + 1), 0.0));
    CHECK(histogram.counts()[bin] == 2);
  }
}

TEST_CASE("what is too small or too large stands at the ends") {
  Binned histogram;
  for (const double value : {-1.0, 0.0, 1e-300}) histogram.add(value);
  CHECK(histogram.counts().front() == 3);
  for (const double value : {0.25, 1e300}) histogram.add(value);
  CHECK(histogram.counts().back() == 2);
  CHECK(histogram.total() == 5);
  CHECK(histogram.quantile(0.5) == 0.0);  // no more is known of the smallest
}

TEST_CASE("a quantile is the edge of the bin where the counts pass it") {
  Binned low, high;
  for (int i = 0; i < 4; ++i) low.add(1e-6);
  for (int i = 0; i < 96; ++i) high.add(1e-3);
  CHECK(low.quantile(0.05) == Binned(low).quantile(0.99));
  Binned both = low;
  both.merge(high);
  CHECK(both.total() == 100);
  CHECK(both.quantile(0.039) == low.quantile(0.5));
  CHECK(both.quantile(0.041) == high.quantile(0.5));
  CHECK(Binned().quantile(0.5) == 0.0);
}
