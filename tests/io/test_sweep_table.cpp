// What a sweep writes: its manifest, its table, and the record of the attempts.
#include "io/directory_lock.hpp"
#include "io/file_error.hpp"
#include "io/run_record.hpp"
#include "io/sweep_manifest.hpp"
#include "io/sweep_table.hpp"
#include "tests/io/file_fixture.hpp"

#include <cmath>

using namespace riesel::io;
using namespace file_fixture;

namespace {

Manifest example() {
  return {.varied = {{"contact.restitution", "1"}, {"contact.law", ""}},
          .points = {{.name = "0123456789abcdef",
                      .parent = "",
                      .branch = "a \"b\"",
                      .leg = "forward",
                      .values = {0.1, std::string("linear")},
                      .expected_seconds = 1.0 / 3.0,
                      .most_threads = 3,
                      .status = "failed",
                      .attempts = 2,
                      .reason = "no,\nnever \xff"},
                     {.name = "fedcba9876543210",
                      .parent = "0123456789abcdef",
                      .branch = {},
                      .leg = {},
                      .values = {Cell{}, Cell{}},
                      .expected_seconds = 0.0,
                      .status = "waiting",
                      .reason = {}}}};
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

}  // namespace

TEST_CASE("A manifest reads back as it was written") {
  const ScratchDirectory directory;
  write(directory / manifest_name, to_json(example()));
  const Manifest manifest = read_manifest(directory.path());
  CHECK(manifest.varied[1].key == "contact.law");
  REQUIRE(manifest.points.size() == 2);
  const ManifestPoint& point = manifest.points[0];
  CHECK(point.branch == "a \"b\"");
  CHECK((point.values == example().points[0].values));
  CHECK(point.expected_seconds == 1.0 / 3.0);
  CHECK(point.most_threads == 3);
  CHECK(point.attempts == 2);
  CHECK(point.reason.starts_with("no,\nnever "));
  CHECK((manifest.points[1].values == example().points[1].values));
  CHECK(manifest.points[1].parent == point.name);
}

TEST_CASE("What is not a manifest is refused") {
  const ScratchDirectory directory;
  const auto error = [&] {
    return message_of<FileError>([&] { (void)read_manifest(directory.path()); });
  };
  CHECK(error().find("cannot be opened: No such file or directory; ") != std::string::npos);
  for (const auto* text : {"{}", "[1]"}) {
    write(directory / manifest_name, text);
    CHECK(error().find("is not a manifest of a sweep") != std::string::npos);
    CHECK(error().find("json.exception") == std::string::npos);
  }
  write(directory / manifest_name, "{}");
  CHECK(error().find("key 'format' not found") != std::string::npos);
}

TEST_CASE("A manifest that was cut short is told, with the way to a new one") {
  const ScratchDirectory directory;
  const auto whole = to_json(example());
  for (const auto& text : {std::string(), std::string("x"), whole.substr(0, whole.size() / 2),
                           whole.substr(0, whole.size() - 2)}) {
    write(directory / manifest_name, text);
    CHECK(
        message_of<FileError>([&] { (void)read_manifest(directory.path()); })
        == (directory / manifest_name).string()
               + ": is not complete JSON; run 'riesel sweep' with its sweep file: it writes a new "
                 "one and keeps the results");
  }
  write(directory / manifest_name, std::string(17, '[') + std::string(17, ']'));
  CHECK(contains(message_of<FileError>([&] { (void)read_manifest(directory.path()); }),
                 "manifest.json: is nested too deeply; run 'riesel sweep'"));
}

TEST_CASE("The CSV table quotes what must be and has nothing for a missing value") {
  SweepTable table(2);
  table.set(0, "plain", std::string("x"));
  table.set(0, "odd, \"name\"", std::string("a,b"));
  table.set(1, "odd, \"name\"", std::string("say \"no\"\nnow"));
  table.set(1, "number", 0.1 + 0.2);
  CHECK(to_csv(table)
        == "plain,\"odd, \"\"name\"\"\",number\n"
           "x,\"a,b\",\n"
           ",\"say \"\"no\"\"\nnow\",0.30000000000000004\n");
}

TEST_CASE("A column with a name that no data set can have is told, and nothing is written") {
  const ScratchDirectory directory;
  SweepTable table(1);
  table.set(0, "plain", 1.0);
  write_hdf5(directory / "plain.h5", table, "base: a.yaml\n");
  CHECK(directory.names() == std::vector<std::string>{"plain.h5"});
  table.set(0, "a/b", 1.0);
  const auto error =
      message_of<FileError>([&] { write_hdf5(directory / "sweep.h5", table, "base: a.yaml\n"); });
  CHECK(contains(error, "sweep.h5: cannot hold the table (cannot create the data set /points/a/b"));
  CHECK(contains(error, "; remove the point whose summary.json has such a name"));
  CHECK(directory.names() == std::vector<std::string>{"plain.h5"});
}

TEST_CASE("A summary is flattened: single values with dotted names, no lists") {
  const ScratchDirectory directory;
  const auto path = directory / "summary.json";
  write(path, R"({"a": 1, "b": {"value": 2.5, "deep": {"c": "steady"}}, "list": [1], "n": null,
                  "yes": true, "large": 9007199254740993})");
  const auto values = flat_summary(path);
  REQUIRE(values.size() == 6);
  CHECK((values[0] == std::pair<std::string, Cell>("a", 1.0)));
  CHECK((values[1] == std::pair<std::string, Cell>("b.value", 2.5)));
  CHECK((values[2] == std::pair<std::string, Cell>("b.deep.c", "steady")));
  CHECK((values[3] == std::pair<std::string, Cell>("n", Cell{})));
  CHECK((values[4] == std::pair<std::string, Cell>("yes", "true")));
  CHECK((values[5] == std::pair<std::string, Cell>("large", "9007199254740993")));
  const auto complaint = [&] { return message_of<FileError>([&] { (void)flat_summary(path); }); };
  write(path, "[]");
  CHECK(contains(complaint(), "summary.json: is not a summary of a run; restore the file"));
  write(path, "{\"a\": ");
  CHECK(contains(complaint(), "summary.json: is not complete JSON; restore the file"));
}

TEST_CASE("The record of the attempts is kept, and none is as good as an empty one") {
  const ScratchDirectory directory;
  CHECK(read_run_record(directory.path()).attempts == 0);
  write_run_record(directory.path(), {.attempts = 3, .failure = "diverged"});
  CHECK(read_run_record(directory.path()).attempts == 3);
  CHECK(read_run_record(directory.path()).failure == "diverged");
  write(directory / "attempts.json", "{\"att");
  CHECK(read_run_record(directory.path()).failure.empty());
}

TEST_CASE("Looking whether a directory is locked neither locks nor writes") {
  const ScratchDirectory directory;
  CHECK_FALSE(DirectoryLock::is_held(directory.path()));
  CHECK(directory.names().empty());
  {
    const DirectoryLock lock(directory.path());
    CHECK(in_other_process([&] { return DirectoryLock::is_held(directory.path()) ? 0 : 1; }) == 0);
  }
  CHECK_FALSE(DirectoryLock::is_held(directory.path()));
  const DirectoryLock again(directory.path());
}
