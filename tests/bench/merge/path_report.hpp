#pragma once

#include <functional>
#include <vector>

#include "tests/bench/merge/merge_pairs.hpp"
#include "tests/bench/report.hpp"

namespace lifeline::bench {

using Judged = std::vector<JudgedPair>;

/// The value below which `share` of the values lie; NaN without values.
[[nodiscard]] double quantile(std::vector<double> values, double share);

/// How many of the pairs are of the kind and overlap by [from, to).
[[nodiscard]] std::size_t count_pairs(const Judged& judged,
                                      const std::function<bool(const JudgedPair&)>& which);

/// Writes the default path's figures, each with its bar and with what others reach, and below each
/// the paper's path's.
void write_side_by_side(const Judged& oriented, const Judged& spectra, Report& report);

}  // namespace lifeline::bench
