// Any bytes as a table of grains: read, or refused with a SettingsError. What is read are numbers.
#include "io/csv_table.hpp"
#include "tests/fuzz/attempt.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

using namespace riesel;

namespace {

const std::vector<io::CsvColumn> columns = {{.name = "x", .unit = "m"},
                                            {.name = "vx", .unit = "m/s"},
                                            {.name = "mass", .unit = "kg", .required = false}};

void require_numbers(const io::CsvTable& table) {
  for (std::size_t row = 0; row < table.rows(); ++row)
    for (const io::CsvColumn& column : columns)
      if (table.has(column.name) && !std::isfinite(table.value(row, column.name))) std::abort();
}

}  // namespace

// The name is libFuzzer's. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::attempt<io::SettingsError>(
      "table", [&] { require_numbers(io::parse_csv(text, "fuzz.csv", columns)); });
  return 0;
}
