// Where results are to be kept.
#pragma once

#include <filesystem>

namespace riesel::bench {

/// Makes the folder of `out`. To be called before anything is timed: nobody measures for minutes
/// what cannot be kept. Throws Mistake if `out` cannot be written.
void reject_unfit_place(const std::filesystem::path& out);

}  // namespace riesel::bench
