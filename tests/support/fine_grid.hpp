#pragma once

#include "common/grid/tsd_grid.hpp"

namespace lifeline {

/// The grid that most tests map into.
inline constexpr GridGeometry kGeometry{.cell_size_m = 0.05, .truncation_m = 0.15};

}  // namespace lifeline
