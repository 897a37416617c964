#include "io/run_record.hpp"

#include "io/build_info.hpp"
#include "io/durable_file.hpp"
#include "io/json_cell.hpp"
#include "io/json_file.hpp"

#include <exception>

namespace riesel::io {
namespace {

constexpr auto record_name = "attempts.json";

}  // namespace

RunRecord read_run_record(const std::filesystem::path& directory) {
  try {
    const auto json = read_json(directory / record_name, {});
    return {.attempts = integer_of<int>(json.at("attempts")),
            .failure = json.at("failure"),
            .changes = json.value("changes", std::vector<std::string>())};
  } catch (const std::exception&) {
    return {};
  }
}

void write_run_record(const std::filesystem::path& directory, const RunRecord& record) {
  const Json json = {{"riesel_version", std::string(build_info().version)},
                     {"attempts", record.attempts},
                     {"failure", record.failure},
                     {"changes", record.changes}};
  write_durably(directory / record_name, text_of(json));
}

}  // namespace riesel::io
