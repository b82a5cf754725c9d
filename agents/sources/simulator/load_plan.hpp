#pragma once

#include <string>

#include "agents/sources/simulator/office.hpp"
#include "agents/sources/simulator/plan.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// The plan that TARGET of `sim:TARGET` names: "office", made up from `office`, or a HouseExpo file
/// (.json; `office` is then ignored). unsupported for other kinds of files.
[[nodiscard]] Result<FloorPlan> load_plan(const std::string& target, const OfficeOptions& office);

}  // namespace lifeline::sources
