#include "tests/bench/merge/crossed_pairs.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "agents/sources/simulator/draw.hpp"

namespace lifeline::bench {
namespace {

struct DrawnMap {
  std::string name, building;
  const matching::MapFeatures* features;
};

DrawnMap draw_map(const std::vector<MergePair>& pairs, sources::Draw& draw) {
  const auto number = static_cast<std::size_t>(draw.below(static_cast<int>(pairs.size())));
  const MergePair& pair = pairs[number];
  if (draw.chance(0.5)) return {pair.name + "a", pair.building_a, &pair.a};
  return {pair.name + "b", pair.building_b, &pair.b};
}

}  // namespace

CrossedOutcome match_crossed(const std::vector<MergePair>& pairs, std::size_t count,
                             std::uint64_t seed, const matching::MatchConfig& config) {
  CrossedOutcome outcome;
  const bool one_building = std::all_of(pairs.begin(), pairs.end(), [&](const MergePair& pair) {
    return pair.building_a == pairs.front().building_a && pair.building_b == pair.building_a;
  });
  if (one_building) return outcome;
  sources::Draw draw(seed);
  while (outcome.pairs < count) {
    const DrawnMap one = draw_map(pairs, draw), other = draw_map(pairs, draw);
    if (one.building == other.building) continue;
    ++outcome.pairs;
    const auto result = matching::match_maps(*one.features, *other.features, config);
    if (!result.accepted()) continue;
    outcome.accepted.push_back(fmt::format("{} and {}: {}", one.name, other.name, result.reason));
  }
  return outcome;
}

}  // namespace lifeline::bench
