#include "io/provenance.hpp"

#include "io/build_info.hpp"
#include "io/shell_words.hpp"
#include "io/utf8.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>

namespace riesel::io {
namespace {

constexpr auto not_known = "unknown";

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  if (H5get_libversion(&major, &minor, &release) < 0) return not_known;
  return fmt::format("{}.{}.{}", major, minor, release);
}

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const auto value = line.find(": ");
    return value == std::string::npos ? not_known : line.substr(value + 2);
  }
  return not_known;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : not_known;
}

std::string date() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

std::string command_line(const std::vector<std::string>& arguments) {
  std::string line;
  for (const auto& argument : arguments) line += (line.empty() ? "" : " ") + in_quotes(argument);
  return made_utf8(line);  // file names may be any bytes
}

void add_build(Provenance& provenance) {
  const auto& build = build_info();
  provenance.emplace_back("riesel_version", build.version);
  provenance.emplace_back("git_commit", build.git_commit);
  provenance.emplace_back("git_dirty", build.git_dirty ? "true" : "false");
  provenance.emplace_back("compiler", build.compiler);
  provenance.emplace_back("flags", build.flags);
  provenance.emplace_back("build_type", build.build_type);
  provenance.emplace_back("hdf5_version", hdf5_version());
  provenance.emplace_back("yaml_cpp_version", RIESEL_YAML_CPP_VERSION);
  provenance.emplace_back("eigen_version", RIESEL_EIGEN_VERSION);
}

void add_machine(Provenance& provenance) {
  provenance.emplace_back("cpu", cpu_model());
  provenance.emplace_back("host", host_name());
  if (const char* job = std::getenv("SLURM_JOB_ID")) provenance.emplace_back("slurm_job_id", job);
}

void add_origin(Provenance& provenance, const RunOrigin& origin) {
  provenance.emplace_back("command", command_line(origin.arguments));
  provenance.emplace_back("threads", std::to_string(origin.threads));
  provenance.emplace_back("seed", std::to_string(origin.seed));
  provenance.emplace_back("source", origin.source);
  provenance.emplace_back("settings", origin.settings);
  if (!origin.continues.empty()) provenance.emplace_back("continues", origin.continues);
  if (origin.run) provenance.emplace_back(run_key, fmt::format("{:016x}", *origin.run));
}

}  // namespace

Provenance collect_provenance(const RunOrigin& origin) {
  Provenance provenance{{"date", date()}};
  add_build(provenance);
  add_machine(provenance);
  add_origin(provenance, origin);
  return provenance;
}

}  // namespace riesel::io
