#include "io/state_columns.hpp"

namespace riesel::io {

void write_column(Hdf5Group& group, const std::string& name, const std::string& unit,
                  const std::vector<ExactSum>& sums) {
  std::vector<std::int64_t> halves;
  for (const auto& sum : sums) {
    halves.insert(halves.end(), {sum.high(), static_cast<std::int64_t>(sum.low())});
  }
  write_column<std::int64_t>(group, name, unit, halves, 2);
}

void read_column(const StoredGroup& group, const std::string& name, std::vector<ExactSum>& sums) {
  const auto data = group.data(name);
  const auto shape = data.shape();
  if (shape.columns != 2) refuse_size(name);
  std::vector<std::int64_t> halves(2 * shape.rows);
  data.read(std::span(halves));
  sums.clear();
  for (std::size_t i = 0; i < halves.size(); i += 2) {
    sums.push_back(ExactSum::from_halves(halves[i], static_cast<std::uint64_t>(halves[i + 1])));
  }
}

}  // namespace riesel::io
