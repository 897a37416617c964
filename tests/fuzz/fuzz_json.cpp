// Any bytes as the JSON files of runs and sweeps: read, or refused with a FileError.
#include "io/run_record.hpp"
#include "io/summary.hpp"
#include "io/summary_reader.hpp"
#include "io/sweep_manifest.hpp"
#include "io/sweep_table.hpp"
#include "tests/fuzz/attempt.hpp"
#include "tests/scratch_directory.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

using namespace riesel;
using fuzz::attempt;

namespace {

namespace fs = std::filesystem;

/// A directory in which one file goes by all the names that are read.
class Directory {
public:
  Directory() {
    put(nullptr, 0);
    for (const char* other : {io::manifest_name, "attempts.json"})
      fs::create_hard_link(directory_ / io::summary_name, directory_ / other);
  }

  const fs::path& path() const { return directory_.path(); }

  void put(const char* bytes, std::size_t size) const {
    std::ofstream file(directory_ / io::summary_name, std::ios::binary | std::ios::trunc);
    file.write(bytes, static_cast<std::streamsize>(size));
  }

private:
  ScratchDirectory directory_;
};

}  // namespace

// The name is libFuzzer's. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Directory directory;
  directory.put(reinterpret_cast<const char*>(data), size);
  attempt("summary", [&] { io::read_summary(directory.path() / io::summary_name); });
  attempt("row", [&] { (void)io::flat_summary(directory.path() / io::summary_name); });
  attempt("manifest", [&] { io::read_manifest(directory.path()); });
  // It refuses nothing: what does not fit are no attempts.
  if (io::read_run_record(directory.path()).attempts > 0) fuzz::accepted_by.insert("attempts");
  return 0;
}
