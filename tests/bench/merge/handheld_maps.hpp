#pragma once

#include <filesystem>

#include "tests/bench/report.hpp"

namespace lifeline::bench {

/// Maps made by hand-held depth sensors, with drift (Halmstad robot maps): `folder` holds
/// SITE/*.png and SITE/alignments.csv, fits to points that people marked. Every pair of a site is
/// matched; right is what lies within 1.5 m and 6 deg of the rigid fit, which itself is 0.1 to 0.8
/// m off. Fits that are more than 2 m off (points marked wrongly) and drawn layouts are left out.
/// Writes no rows where the folder is not there.
void write_handheld_rows(const std::filesystem::path& folder, Report& report);

}  // namespace lifeline::bench
