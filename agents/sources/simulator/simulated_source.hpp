#pragma once

#include <memory>
#include <vector>

#include "agents/sensing/scan_source.hpp"
#include "agents/sources/simulator/finds.hpp"
#include "agents/sources/simulator/plan.hpp"
#include "agents/sources/source_spec.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// A person with a lidar on the head walks about a building: `sim:TARGET?options`, see
/// docs/simulator.md. The same spec gives the same scans, bit for bit on one platform. Every scan
/// carries its truth. Errors are of one line: wrong_use for options and an unknown target,
/// not_found and bad_data for a plan file.
[[nodiscard]] Result<std::unique_ptr<sensing::ScanSource>> open_simulated_source(
    const SourceSpec& spec);

/// The building in which the source of this spec walks: for judging maps against its walls.
[[nodiscard]] Result<FloorPlan> load_plan(const SourceSpec& spec);

/// What is to be found in the building of this spec, and where: for judging finds.
[[nodiscard]] Result<std::vector<Find>> load_finds(const SourceSpec& spec);

}  // namespace lifeline::sources
