#include "bench/machine.hpp"

#include "engine/aligned.hpp"

#include <fmt/core.h>
#include <omp.h>
#include <unistd.h>

#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

namespace riesel::bench {

namespace {

std::string first_line(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  return std::getline(file, line) ? line : "unknown";
}

/// Virtual machines often have a name that many processors share: family and model tell them apart.
std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  std::map<std::string, std::string> first;  // processor
  for (std::string line; std::getline(file, line) && !line.empty();)
    if (const auto end = line.find(": "); end != std::string::npos)
      first[line.substr(0, line.find('\t'))] = line.substr(end + 2);
  if (first["model name"].empty()) return "unknown";
  return fmt::format("{} family {} model {}", first["model name"], first["cpu family"],
                     first["model"]);
}

/// "2048K" and the like.
std::size_t bytes_of(const std::string& size) {
  const std::size_t number = std::strtoull(size.c_str(), nullptr, 10);
  return number << (size.ends_with('K') ? 10 : size.ends_with('M') ? 20 : 0);
}

std::vector<Cache> caches() {
  std::vector<Cache> found;
  const std::filesystem::path all = "/sys/devices/system/cpu/cpu0/cache";
  for (int index = 0; std::filesystem::exists(all / fmt::format("index{}", index)); ++index) {
    const auto one = all / fmt::format("index{}", index);
    found.push_back({.level = std::atoi(first_line(one / "level").c_str()),
                     .kind = first_line(one / "type"),
                     .bytes = bytes_of(first_line(one / "size"))});
  }
  return found;
}

/// By the same share of each array as any loop with a static schedule.
void triad(int threads, std::int64_t count, double* a, const double* b, const double* c) {
#pragma omp parallel for simd num_threads(threads) schedule(static)
  for (std::int64_t i = 0; i < count; ++i) a[i] = b[i] + 3.0 * c[i];
}

}  // namespace

std::string Machine::name() const {
  std::string result;
  int open = 0;  // parentheses, as in "(R)": what is in them is left out
  for (const char c : fmt::format("{} {} cores", cpu, cores)) {
    const auto byte = static_cast<unsigned char>(c);
    open += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (std::isalnum(byte) != 0 && open == 0)
      result += static_cast<char>(std::tolower(byte));
    else if (!result.empty() && result.back() != '-' && open == 0)
      result += '-';
  }
  return result;
}

Machine this_machine() {
  Machine machine{.cpu = cpu_model(),
                  .cores = omp_get_num_procs(),
                  .caches = caches(),
                  .memory = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES))
                            * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)),
                  .load_average = {}};
  getloadavg(machine.load_average.data(), static_cast<int>(machine.load_average.size()));
  return machine;
}

std::vector<Bandwidth> measure_bandwidth(std::size_t working_set, int repetitions) {
  const std::size_t count = working_set / 3 / sizeof(double);
  AlignedVector<double> a(count, 0.0), b(count, 1.0), c(count, 2.0);
  const auto pass = [&](int threads) {
    triad(threads, static_cast<std::int64_t>(count), a.data(), b.data(), c.data());
  };
  const std::array threads = {1, 2};
  std::vector<Measurement> contenders;
  for (const int n : threads) {
    pass(n);
    contenders.emplace_back([&pass, n] { return seconds_of([&] { pass(n); }); });
  }
  const std::vector<Timing> timings = in_turns(contenders, repetitions);
  std::vector<Bandwidth> result;
  for (std::size_t i = 0; i < threads.size(); ++i)
    result.push_back({.threads = threads[i], .working_set = working_set, .timing = timings[i]});
  return result;
}

}  // namespace riesel::bench
