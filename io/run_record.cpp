#include "io/run_record.hpp"

#include "io/durable_file.hpp"
#include "io/json_cell.hpp"

#include <fstream>

namespace riesel::io {
namespace {

constexpr auto record_name = "attempts.json";

}  // namespace

RunRecord read_run_record(const std::filesystem::path& directory) {
  std::ifstream stream(directory / record_name);
  const auto json = stream ? Json::parse(stream, nullptr, false) : Json();
  if (!json.is_object()) return {};
  return {.attempts = json.value("attempts", 0), .failure = json.value("failure", "")};
}

void write_run_record(const std::filesystem::path& directory, const RunRecord& record) {
  const Json json = {{"attempts", record.attempts}, {"failure", record.failure}};
  write_durably(directory / record_name, text_of(json));
}

}  // namespace riesel::io
