#include "app/report_parts.hpp"

#include "io/whole_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace riesel::app {

namespace {

bool contains_mark(const std::filesystem::path& file, std::string_view mark) {
  constexpr std::uint64_t most_before_mark = 1000;  // bytes
  return io::beginning_of(file, most_before_mark).find(mark) != std::string::npos;
}

}  // namespace

bool is_own_report(const std::filesystem::path& page) {
  return contains_mark(page, io::mark_of_pages);
}

bool is_own_drawing(const std::filesystem::path& file) {
  return contains_mark(file, io::mark_of_drawings);
}

void remove_own_drawings(const std::filesystem::path& figures,
                         const std::vector<std::string>& kept) {
  if (!std::filesystem::is_directory(figures)) return;
  for (const auto& entry : std::filesystem::directory_iterator(figures)) {
    const bool is_own = entry.is_regular_file() && !entry.is_symlink()
                        && entry.path().extension() == ".svg" && is_own_drawing(entry.path());
    if (is_own && std::ranges::find(kept, entry.path().stem().string()) == kept.end())
      std::filesystem::remove(entry.path());
  }
}

void ReportDraft::add_figure(const std::string& name, const io::Svg& svg,
                             std::string_view caption) {
  add_figure(name, svg, svg, caption);
}

void ReportDraft::add_figure(const std::string& name, const io::Svg& in_page,
                             const io::Svg& as_file, std::string_view caption) {
  page_.figure(in_page, caption);
  figures_.push_back({.name = name, .svg = as_file});
}

void ReportDraft::add_origin(const io::RunSummary& run, const io::RunHistory& history,
                             const std::string& effective_settings) {
  page_.heading("Settings and origin");
  page_.folded("Effective settings: running them again gives the same bits", effective_settings);
  io::HtmlRows rows = {
      {"origin", ""},
      {"state hash", fmt::format("{:016x}", run.state_hash)},
      {"performance", fmt::format("{:.3g} particle-steps/s, threads: {}, {:.3g} s",
                                  run.particle_steps_per_second, run.threads, run.wall_seconds)}};
  for (const auto& [name, value] : history.start) rows.push_back({name, value});
  for (std::size_t i = 0; i < history.resumes.size(); ++i)
    for (const auto& entry : history.resumes[i])
      if (std::ranges::count(history.start, entry) == 0)  // tell what is new
        rows.push_back({fmt::format("resume {}: {}", i + 1, entry.first), entry.second});
  page_.table(rows);
}

std::string number(double value, const char* form) {
  return std::isnan(value) ? "not known" : fmt::format(fmt::runtime(form), value);
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{} ({})", name, unit);
}

std::string class_of(Validity validity) {
  if (validity == Validity::valid) return "good";
  return validity == Validity::suspect ? "doubtful" : "bad";
}

}  // namespace riesel::app
