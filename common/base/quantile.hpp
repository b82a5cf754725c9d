#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lifeline {

/// The value below which a share `q` in [0, 1] of the values lies (nearest rank); 0 when there are
/// none.
[[nodiscard]] inline double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::size_t>(q * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank),
                   values.end());
  return values[rank];
}

}  // namespace lifeline
