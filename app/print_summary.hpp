// The result of a run on the screen.
#pragma once

#include "io/summary.hpp"

#include <filesystem>

namespace riesel::app {

void print_summary(const io::FlowSummary& summary, const std::filesystem::path& directory);
void print_summary(const io::CurveSummary& summary, const std::filesystem::path& directory);
void print_summary(const io::ColumnSummary& summary, const std::filesystem::path& directory);

}  // namespace riesel::app
