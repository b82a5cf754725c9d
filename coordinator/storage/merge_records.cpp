#include "coordinator/storage/merge_records.hpp"

#include <limits>
#include <optional>

#include "idl/state.pb.h"

namespace lifeline {
namespace {

constexpr int kMostEdges = 64 * 63 / 2;
constexpr double kFarthest_m = 1e6;

void write_layer(const LayerKey& layer, proto::KeptLayer& kept) {
  kept.set_agent_id(layer.agent_id.text());
  kept.set_map_id(layer.map_id.value);
  kept.set_floor(layer.floor.value);
}

std::optional<LayerKey> read_layer(const proto::KeptLayer& kept) {
  auto id = AgentId::parse(kept.agent_id());
  if (!id || kept.floor() < std::numeric_limits<std::int16_t>::min() ||
      kept.floor() > std::numeric_limits<std::int16_t>::max()) {
    return std::nullopt;
  }
  return LayerKey{*std::move(id), MapId{kept.map_id()},
                  Floor{static_cast<std::int16_t>(kept.floor())}};
}

std::optional<merging::LayerPair> read_pair(const proto::KeptLayer& kept_a,
                                            const proto::KeptLayer& kept_b) {
  auto a = read_layer(kept_a), b = read_layer(kept_b);
  if (!a || !b || !(*a < *b)) return std::nullopt;
  return merging::LayerPair{*std::move(a), *std::move(b)};
}

std::optional<merging::MergeEdge> read_edge(const proto::KeptEdge& kept) {
  if (kept.covariance_size() != 6) return std::nullopt;
  const auto c = [&](int i) { return kept.covariance(i); };
  merging::MergeEdge edge;
  edge.T_a_b = {kept.x_m(), kept.y_m(), kept.yaw_rad()};
  edge.covariance << c(0), c(1), c(2), c(1), c(3), c(4), c(2), c(4), c(5);
  edge.quality = kept.quality();
  edge.overlap_centre_b_m = {kept.overlap_x_m(), kept.overlap_y_m()};
  edge.by_hand = kept.by_hand();
  const bool sound = edge.T_a_b.is_finite() && edge.covariance.allFinite() &&
                     edge.covariance.diagonal().minCoeff() >= 0.0 && edge.quality >= 0.0 &&
                     edge.quality <= 1.0 && edge.overlap_centre_b_m.allFinite() &&
                     edge.T_a_b.translation().cwiseAbs().maxCoeff() < kFarthest_m;
  return sound ? std::optional(edge) : std::nullopt;
}

}  // namespace

std::string merges_record(const merging::EdgeMap& edges,
                          const std::set<merging::LayerPair>& apart) {
  proto::KeptMerges message;
  for (const auto& [pair, edge] : edges) {
    proto::KeptEdge& kept = *message.add_edges();
    write_layer(pair.a, *kept.mutable_a());
    write_layer(pair.b, *kept.mutable_b());
    kept.set_x_m(edge.T_a_b.x_m);
    kept.set_y_m(edge.T_a_b.y_m);
    kept.set_yaw_rad(edge.T_a_b.yaw_rad);
    for (int row = 0; row < 3; ++row) {
      for (int column = row; column < 3; ++column)
        kept.add_covariance(edge.covariance(row, column));
    }
    kept.set_quality(edge.quality);
    kept.set_overlap_x_m(edge.overlap_centre_b_m.x());
    kept.set_overlap_y_m(edge.overlap_centre_b_m.y());
    kept.set_by_hand(edge.by_hand);
  }
  for (const auto& pair : apart) {
    proto::KeptPair& kept = *message.add_apart();
    write_layer(pair.a, *kept.mutable_a());
    write_layer(pair.b, *kept.mutable_b());
  }
  return message.SerializeAsString();
}

Result<KeptMerges> read_merges(const store::Records& records) {
  KeptMerges merges;
  const auto record = records.find(kMergesKey);
  if (record == records.end()) return merges;
  proto::KeptMerges message;
  if (!message.ParseFromString(record->second) || message.edges_size() > kMostEdges ||
      message.apart_size() > kMostEdges) {
    return fail(ErrorCode::bad_data, "record merges holds none");
  }
  for (const proto::KeptEdge& kept : message.edges()) {
    auto pair = read_pair(kept.a(), kept.b());
    const auto edge = read_edge(kept);
    if (!pair || !edge) {
      return fail(ErrorCode::bad_data, "record merges holds an edge that is none");
    }
    merges.edges.emplace(*std::move(pair), *edge);
  }
  for (const proto::KeptPair& kept : message.apart()) {
    auto pair = read_pair(kept.a(), kept.b());
    if (!pair) return fail(ErrorCode::bad_data, "record merges holds a pair that is none");
    merges.apart.insert(*std::move(pair));
  }
  return merges;
}

}  // namespace lifeline
