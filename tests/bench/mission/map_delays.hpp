#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/base/result.hpp"

namespace lifeline::bench {

/// How long it took from a scan until it was in the common map of every helmet, by what they wrote
/// down (lifeline-agent run --journal).
struct MapDelays {
  std::vector<double> seconds;  ///< of each revision published while all shared one map
  std::size_t missing = 0;      ///< revisions that somebody never took in
  /// Parts of the delay, of the same revisions: until the revision left, and from there on.
  std::vector<double> until_published_s, until_fused_s;
};

/// `journals`: of all helmets, by name. Revisions count from when everybody had taken in something
/// of everybody until `before_end_s` before the last line: later ones may still have been under
/// way. bad_data where a line is none.
[[nodiscard]] Result<MapDelays> map_delays(
    const std::map<std::string, std::filesystem::path>& journals, double before_end_s);

}  // namespace lifeline::bench
