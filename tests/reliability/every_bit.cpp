// Flips each bit of a small checkpoint.h5 and run.h5, and cuts them at each length: a reader must
// notice. Then the same flips behind a seal that is made right again, as if they were forged: these
// need not be noticed where a value is as good as the other, but must do no harm: what is believed
// goes on for some steps.
//
// every_bit [STRIDE [FORGERIES]]: each bit and length, or those of every STRIDE-th byte; behind a
// forged seal those of every FORGERIES-th.
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "io/checkpoint.hpp"
#include "io/file_error.hpp"
#include "io/run_file.hpp"
#include "io/run_reader.hpp"
#include "io/seal.hpp"
#include "tests/engine/systems.hpp"
#include "tests/memory_file.hpp"
#include "tests/small_files.hpp"

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string_view>
#include <vector>

using namespace riesel;

namespace {

using Read = void (*)(const std::filesystem::path&);

void read_checkpoint(const std::filesystem::path& path) { io::read_checkpoint(path); }
void read_run_file(const std::filesystem::path& path) { io::read_run_file(path); }

/// As `riesel resume` does. That it cannot go on for long is no harm.
void go_on_from_checkpoint(const std::filesystem::path& path) {
  const io::Checkpoint found = io::read_checkpoint(path);
  try {
    Simulation simulation(found.state, systems::paper_model(), 2, Stepping::windows);
    simulation.advance(200);
    observe(simulation.state());
  } catch (const RunFailure&) {
    return;
  }
}

bool is_refused(Read read, const std::filesystem::path& path) {
  try {
    read(path);
    return false;
  } catch (const io::FileError&) {
    return true;
  }
}

struct Count {
  long tried = 0, refused = 0;
  void add(bool is_refused) {
    ++tried;
    if (is_refused) ++refused;
  }
};

char with_flipped_bit(char byte, int bit) { return static_cast<char>(byte ^ (1 << bit)); }

Count flip_bits(const std::vector<char>& good, Read read, std::size_t stride) {
  Count count;
  const MemoryFile file(good);
  for (std::size_t place = 0; place < good.size(); place += stride) {
    for (int bit = 0; bit < 8; ++bit) {
      file.put(place, with_flipped_bit(good[place], bit));
      count.add(is_refused(read, file.path()));
    }
    file.put(place, good[place]);
  }
  return count;
}

Count cut(const std::vector<char>& good, Read read, std::size_t stride) {
  Count count;
  const MemoryFile file(good);
  for (std::size_t less = 1; less <= good.size(); less += stride) {
    file.cut(good.size() - less);
    count.add(is_refused(read, file.path()));
  }
  return count;
}

Count forge(const std::vector<char>& good, std::string_view kind, Read read, std::size_t stride) {
  Count count;
  std::vector<char> forged = good;
  for (std::size_t place = io::seal_size; place < good.size(); place += stride) {
    for (int bit = 0; bit < 8; ++bit) {
      forged[place] = with_flipped_bit(good[place], bit);
      io::seal(forged, kind);
      count.add(is_refused(read, MemoryFile(forged).path()));
    }
    forged[place] = good[place];
  }
  return count;
}

struct Strides {
  std::size_t damage, forgeries;  ///< bytes
};

/// Whether all was noticed that must be.
bool try_all(const char* kind, void (*write)(const std::filesystem::path&), Read read, Read believe,
             const Strides& strides) {
  const auto good = small_file(write);
  if (is_refused(read, MemoryFile(good).path())) return false;
  const Count flips = flip_bits(good, read, strides.damage), cuts = cut(good, read, strides.damage),
              forgeries = forge(good, kind, believe, strides.forgeries);
  std::printf("%s, %zu bytes: noticed %ld of %ld flipped bits and %ld of %ld lengths; behind a "
              "forged seal refused %ld of %ld flipped bits\n",
              kind, good.size(), flips.refused, flips.tried, cuts.refused, cuts.tried,
              forgeries.refused, forgeries.tried);
  return flips.refused == flips.tried && cuts.refused == cuts.tried;
}

/// The exit status.
int answer(int argc, char** argv) {
  const std::size_t damage = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 1;
  const std::size_t forgeries = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : damage;
  if (damage < 1 || forgeries < 1) return 2;
  const Strides strides{.damage = damage, .forgeries = forgeries};
  const bool checkpoint = try_all("checkpoint", write_small_checkpoint, read_checkpoint,
                                  go_on_from_checkpoint, strides);
  const bool run =
      try_all(io::run_file_kind, write_small_run_file, read_run_file, read_run_file, strides);
  return checkpoint && run ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return answer(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
