#pragma once

#include "coordinator/matching/match_types.hpp"
#include "tests/bench/report.hpp"

namespace lifeline::bench {

/// Ten helmets map one office for two minutes; each map's features are computed once, then all 45
/// pairs are matched on one thread. Rows: the time of it all and of each step, right and wrong
/// merges, errors against the exact truth. Then the same with coarse cells, as helmets share them.
void write_fleet_rows(Report& report);

}  // namespace lifeline::bench
