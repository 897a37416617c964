#include "app/command_words.hpp"

#include "scenarios/scenario.hpp"

#include <map>
#include <set>

namespace riesel::app {

namespace {

/// By the name, as command.cpp uses the same names throughout.
WordKind kind_of(const std::string& name) {
  static const std::map<std::string, WordKind> known = {
      {"FILE", WordKind::file}, {"DIR", WordKind::directory}, {"SCENARIO", WordKind::scenario},
      {"--set", WordKind::key}, {"SHELL", WordKind::shell},   {"--out", WordKind::directory},
  };
  const auto found = known.find(name);
  return found == known.end() ? WordKind::other : found->second;
}

std::string value_name(const std::string& name) {
  static const std::map<std::string, std::string> known = {
      {"--out", "DIR"}, {"--set", "KEY=VALUE"}, {"--max-walltime", "TIME"}, {"--sbatch", "OPTION"}};
  const auto found = known.find(name);
  return found == known.end() ? "N" : found->second;
}

CommandWord word_of(const CLI::Option& option) {
  CommandWord word{.names = {}, .value = "", .meaning = option.get_description(), .kind = {}};
  for (const auto& name : option.get_snames()) word.names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) word.names.push_back("--" + name);
  if (word.names.empty()) word.names = {option.get_name()};
  const std::string& longest = word.names.back();
  const bool is_flag = option.get_items_expected_max() == 0;
  if (!is_flag && longest.starts_with("-")) word.value = value_name(longest);
  word.kind = is_flag ? WordKind::flag : kind_of(longest);
  return word;
}

}  // namespace

std::vector<Subcommand> subcommands_of(const CLI::App& program) {
  std::vector<Subcommand> all;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    Subcommand described{.name = command->get_name(),
                         .meaning = command->get_description(),
                         .places = {},
                         .options = {}};
    for (const CLI::Option* option : command->get_options()) {
      auto& words = option->get_positional() ? described.places : described.options;
      words.push_back(word_of(*option));
    }
    all.push_back(std::move(described));
  }
  return all;
}

std::vector<std::string> keys_of_settings() {
  std::set<std::string> keys;
  for (const auto& [scenario, table] : scenarios::settings_tables())
    for (const io::Setting& row : table) keys.insert(row.key);
  return {keys.begin(), keys.end()};
}

}  // namespace riesel::app
