#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "common/base/check.hpp"
#include "common/sharing/accept.hpp"
#include "common/sharing/fixed_transform.hpp"
#include "common/sharing/fleet_detection.hpp"

namespace lifeline::sharing {
namespace {

constexpr auto kGateUm = static_cast<std::int64_t>(kSameFindM * 1e6);

/// A detection where it lies.
struct Placed {
  const wire::Detection* detection = nullptr;
  LayerKey layer;
  std::optional<std::uint16_t> group;
  PointUm p;

  /// Of what can be one with it: same frame, floor and kind.
  [[nodiscard]] auto family() const {
    return std::tuple(!group.has_value(), group.value_or(0),
                      group ? std::optional<LayerKey>() : layer, layer.floor, detection->kind);
  }
};

std::int64_t to_um(double metres) {
  return std::llround(metres * 1e6);
}

Placed place(const wire::Detection& detection, const std::map<LayerKey, GroupPlace>& places) {
  auto layer = to_layer_key({detection.agent_id, detection.map_id, detection.floor});
  LIFELINE_CHECK(layer.has_value());
  Placed placed{
      &detection, *std::move(layer), std::nullopt, {to_um(detection.x_m), to_um(detection.y_m)}};
  if (const auto found = places.find(placed.layer); found != places.end()) {
    placed.group = found->second.group;
    placed.p = transform(found->second.T_common_map, placed.p);
  }
  return placed;
}

/// Square of the distance; empty beyond the gate.
std::optional<std::int64_t> near(const Placed& a, const Placed& b) {
  const std::int64_t dx = a.p.x - b.p.x, dy = a.p.y - b.p.y;
  if (std::abs(dx) > kGateUm || std::abs(dy) > kGateUm) return std::nullopt;
  const std::int64_t square = dx * dx + dy * dy;
  return square <= kGateUm * kGateUm ? std::optional(square) : std::nullopt;
}

bool can_be_one(const Placed& a, const Placed& b) {
  return a.layer != b.layer && near(a, b).has_value();
}

using Find = std::vector<const Placed*>;  // in the order of keys

/// Members of one family as finds: pairs from the closest on, as long as all of a find fit
/// together.
std::vector<Find> find_in(const std::vector<const Placed*>& family) {
  struct Pair {
    std::int64_t square;
    std::size_t a, b;
    auto operator<=>(const Pair&) const = default;
  };
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < family.size(); ++a) {
    for (std::size_t b = a + 1; b < family.size(); ++b) {
      if (!can_be_one(*family[a], *family[b])) continue;
      pairs.push_back({*near(*family[a], *family[b]), a, b});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::size_t> find_of(family.size());
  std::iota(find_of.begin(), find_of.end(), 0U);
  std::vector<Find> finds;
  for (const Placed* each : family) finds.push_back({each});
  for (const Pair& pair : pairs) {
    const std::size_t into = find_of[pair.a], from = find_of[pair.b];
    if (into == from) continue;
    const bool all_fit = std::all_of(finds[into].begin(), finds[into].end(), [&](const Placed* a) {
      return std::all_of(finds[from].begin(), finds[from].end(),
                         [&](const Placed* b) { return can_be_one(*a, *b); });
    });
    if (!all_fit) continue;
    finds[into].insert(finds[into].end(), finds[from].begin(), finds[from].end());
    finds[from].clear();
    std::replace(find_of.begin(), find_of.end(), from, into);
  }
  std::erase_if(finds, [](const Find& find) { return find.empty(); });
  return finds;
}

int rank(wire::DetectionState state) {
  switch (state) {
    case wire::DetectionState::dismissed:
      return 0;
    case wire::DetectionState::reported:
      return 1;
    case wire::DetectionState::confirmed:
      return 2;
    case wire::DetectionState::rescued:
      break;
  }
  return 3;
}

FleetDetection summarise(Find find) {
  std::sort(find.begin(), find.end(), [](const Placed* a, const Placed* b) {
    return std::tie(a->layer, a->detection->detection_id) <
           std::tie(b->layer, b->detection->detection_id);
  });
  const Placed& lowest = *find.front();
  const wire::Detection& one = *lowest.detection;
  FleetDetection all{.group = lowest.group,
                     .layer = lowest.layer,
                     .kind = one.kind,
                     .state = one.state,
                     .first = {one.first_seen_at_ns, one.agent_id},
                     .last = {one.seen_at_ns, one.agent_id},
                     .seen_by = {}};
  std::int64_t weights = 0, sum_x = 0, sum_y = 0;  // 1024 x 1000 x 4e9 at most
  double all_wrong = 1.0;
  for (const Placed* each : find) {
    const wire::Detection& detection = *each->detection;
    const std::int64_t weight = 1 + std::llround(999.0 * detection.confidence);
    weights += weight;
    sum_x += weight * each->p.x;
    sum_y += weight * each->p.y;
    all_wrong *= 1.0 - static_cast<double>(detection.confidence);
    if (rank(detection.state) > rank(all.state)) all.state = detection.state;
    all.first = std::min(all.first, {detection.first_seen_at_ns, detection.agent_id});
    all.last = std::max(all.last, {detection.seen_at_ns, detection.agent_id});
    all.seen_by.push_back(detection.agent_id);
    all.made_of.emplace_back(detection.agent_id, detection.detection_id);
  }
  all.seen_by.erase(std::unique(all.seen_by.begin(), all.seen_by.end()), all.seen_by.end());
  all.x_m = static_cast<double>(sum_x / weights) / 1e6;
  all.y_m = static_cast<double>(sum_y / weights) / 1e6;
  all.confidence = 1.0 - all_wrong;
  return all;
}

}  // namespace

std::vector<FleetDetection> associate(const std::map<DetectionKey, wire::Detection>& detections,
                                      const std::map<LayerKey, GroupPlace>& places) {
  std::vector<Placed> placed;
  placed.reserve(detections.size());
  for (const auto& [key, detection] : detections) placed.push_back(place(detection, places));
  using Family = decltype(placed.front().family());
  std::map<Family, std::vector<const Placed*>> families;
  for (const Placed& each : placed) families[each.family()].push_back(&each);
  std::vector<FleetDetection> all;
  for (const auto& [family, members] : families) {
    const std::size_t begin = all.size();
    for (Find& find : find_in(members)) all.push_back(summarise(std::move(find)));
    std::sort(all.begin() + static_cast<std::ptrdiff_t>(begin), all.end(),
              [](const FleetDetection& a, const FleetDetection& b) {
                return std::tie(a.x_m, a.y_m, a.first, a.layer) <
                       std::tie(b.x_m, b.y_m, b.first, b.layer);
              });
  }
  return all;
}

}  // namespace lifeline::sharing
