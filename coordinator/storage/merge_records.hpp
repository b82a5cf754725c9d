#pragma once

#include <set>
#include <string>

#include "common/base/result.hpp"
#include "common/store/record_file.hpp"
#include "coordinator/merging/merge_graph.hpp"

namespace lifeline {

inline constexpr const char* kMergesKey = "merges";

/// The graph's edges, and the pairs that a person parted.
struct KeptMerges {
  merging::EdgeMap edges;
  std::set<merging::LayerPair> apart{};
};

/// They as a record, and back; nothing where there is no record. bad_data for what makes no merge.
[[nodiscard]] std::string merges_record(const merging::EdgeMap& edges,
                                        const std::set<merging::LayerPair>& apart = {});
[[nodiscard]] Result<KeptMerges> read_merges(const store::Records& records);

}  // namespace lifeline
