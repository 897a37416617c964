// Feeds a fuzz target what the corpus holds: the fuzzer's work, repeated by any compiler, as far as
// checksums let it, which are taken for right by the fuzzer only (io/bytes.hpp).
//
//   replay CORPUS [READER:FILE...]     fails unless these files are accepted by these readers
#include "tests/fuzz/attempt.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

// The name is libFuzzer's. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// By which readers each file is accepted.
using Acceptance = std::map<std::string, std::set<std::string>>;

Acceptance replay(const std::filesystem::path& corpus) {
  Acceptance accepted;
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    std::printf("%s\n", entry.path().filename().c_str());  // the last one is who crashed
    std::fflush(stdout);
    const auto bytes = contents(entry.path());
    fuzz::accepted_by.clear();
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    accepted[entry.path().filename().string()] = fuzz::accepted_by;
  }
  return accepted;
}

/// Complains of those of "READER:FILE" that are not so: what is refused early tries nothing.
bool are_accepted(const Acceptance& accepted, const std::vector<std::string>& wanted) {
  bool all = true;
  for (const std::string& pair : wanted) {
    const auto colon = pair.find(':');
    const auto reader = pair.substr(0, colon), file = pair.substr(colon + 1);
    const auto found = accepted.find(file);
    if (found != accepted.end() && found->second.contains(reader)) continue;
    std::fprintf(stderr, "%s is not accepted as %s\n", file.c_str(), reader.c_str());
    all = false;
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) return 2;
    const Acceptance accepted = replay(argv[1]);
    if (accepted.empty()) return 2;
    return are_accepted(accepted, {argv + 2, argv + argc}) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
