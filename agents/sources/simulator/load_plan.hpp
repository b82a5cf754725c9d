#pragma once

#include <string>

#include "agents/sources/simulator/office.hpp"
#include "agents/sources/simulator/plan.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// The plan that TARGET of `sim:TARGET` names: "office", made up from `office`, a HouseExpo file
/// (.json) or a picture (.png); `office` is then ignored. wrong_use for anything else.
[[nodiscard]] Result<FloorPlan> load_plan(const std::string& target, const OfficeOptions& office);

}  // namespace lifeline::sources
