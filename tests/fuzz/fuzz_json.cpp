// Any bytes as the JSON files of runs and sweeps: read, or refused with a FileError.
#include "io/file_error.hpp"
#include "io/summary_reader.hpp"
#include "io/sweep_manifest.hpp"
#include "io/sweep_table.hpp"
#include "tests/fuzz/memory_file.hpp"

#include <cstddef>
#include <cstdint>

using namespace riesel;

namespace {

template <class Read>
void attempt(Read read) {
  try {
    read();
  } catch (const io::FileError&) {
  }
}

}  // namespace

// The name is libFuzzer's.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file({reinterpret_cast<const char*>(data), size});
  attempt([&] { io::read_summary(file.path()); });
  attempt([&] { io::flat_summary(file.path()); });
  attempt([&] { io::manifest_of_file(file.path()); });
  attempt([&] { io::read_record_of_file(file.path()); });
  return 0;
}
