#include "bench/child.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace riesel::bench {

namespace {

/// As a shell takes it.
std::string in_quotes(const std::string& argument) {
  std::string quoted = "'";
  for (const char c : argument) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

nlohmann::json ask_child(const std::vector<std::string>& arguments) {
  std::string command = in_quotes(std::filesystem::read_symlink("/proc/self/exe").string());
  for (const std::string& argument : arguments) command += " " + in_quotes(argument);

  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start " + command);
  std::string output;
  std::array<char, 4096> part{};
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe))
    output.append(part.data(), count);
  if (pclose(pipe) != 0) throw std::runtime_error("this failed: " + command);
  return nlohmann::json::parse(output);
}

}  // namespace riesel::bench
