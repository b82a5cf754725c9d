#include "common/sharing/accept.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <tuple>

#include "common/base/sha256.hpp"
#include "common/grid/tile_index.hpp"
#include "common/wire/limits.hpp"

namespace lifeline::sharing {
namespace {

// Further apart no two maps of one mission begin; fusing in 64 bits needs a bound
// (docs/decisions/0003).
constexpr std::int64_t kMaxTranslationUm = 2'000'000'000;

bool is_rotation(const wire::FixedTransform& transform) {
  const double c = static_cast<double>(transform.cos_q30) / wire::FixedTransform::kOne;
  const double s = static_cast<double>(transform.sin_q30) / wire::FixedTransform::kOne;
  return std::abs(c * c + s * s - 1.0) < 1e-6;
}

}  // namespace

Result<void> check_envelope(const wire::Envelope& envelope, std::string_view mission_id) {
  if (envelope.protocol_version != wire::kProtocolVersion) {
    return fail(ErrorCode::unsupported,
                "sample of protocol version {}, ours is {}; run the same release everywhere",
                envelope.protocol_version, wire::kProtocolVersion);
  }
  if (envelope.mission_id != mission_id) {
    return fail(ErrorCode::bad_data, "sample of another mission");
  }
  if (auto sender = AgentId::parse(envelope.sender_id); !sender) return forward_error(sender);
  return {};
}

Result<LayerKey> to_layer_key(const wire::LayerName& name) {
  auto agent_id = AgentId::parse(name.agent_id);
  if (!agent_id) return forward_error(agent_id);
  return LayerKey{*std::move(agent_id), MapId{name.map_id}, Floor{name.floor}};
}

wire::LayerName to_layer_name(const LayerKey& key) {
  return {key.agent_id.text(), key.map_id.value, key.floor.value};
}

Result<LayerKey> check_pose(const wire::HelmetPose& pose, std::string_view mission_id) {
  if (auto accepted = check_envelope(pose.envelope, mission_id); !accepted)
    return forward_error(accepted);
  if (pose.envelope.sender_id != pose.agent_id || !pose.T_map_head.is_finite())
    return fail(ErrorCode::bad_data, "pose is not finite, or not its sender's");
  return to_layer_key({pose.agent_id, pose.map_id, pose.floor});
}

bool is_believable(Epoch heard, Epoch known) {
  constexpr std::uint64_t kMaxLead = 1'000'000;
  return heard <= known || heard.value - known.value <= kMaxLead;
}

bool outranks(const wire::MergeDirective& one, const wire::MergeDirective& other) {
  const auto rank = [](const wire::MergeDirective& of) {
    return std::tie(of.epoch, of.envelope.incarnation, of.envelope.sender_id);
  };
  return rank(one) > rank(other);
}

bool holds_another_map(const wire::AgentStatus& one, const wire::AgentStatus& other) {
  const bool both_told =
      one.common_map_sha256 != Sha256Digest{} && other.common_map_sha256 != Sha256Digest{};
  const bool other_members = one.fingerprint != other.fingerprint;
  const bool other_map = both_told && one.common_map_sha256 != other.common_map_sha256;
  return one.epoch_applied == other.epoch_applied && (other_members || other_map) &&
         std::ranges::equal(one.layers, other.layers, [](const auto& a, const auto& b) {
           return a.layer == b.layer && a.revisions == b.revisions;
         });
}

Result<void> check_directive(const wire::MergeDirective& directive) {
  if (directive.members.size() > wire::kMaxMembers || directive.own_weight_permille > 1000) {
    return fail(ErrorCode::bad_data,
                "directive {} has {} members and w_T1 {}/1000; limits are {} and 1000/1000",
                directive.epoch, directive.members.size(), directive.own_weight_permille,
                wire::kMaxMembers);
  }
  std::set<LayerKey> seen;
  for (const auto& member : directive.members) {
    auto key = to_layer_key(member.layer);
    if (!key) return forward_error(key);
    const auto& transform = member.T_common_map;
    if (!seen.insert(*key).second || !is_rotation(transform) ||
        std::abs(transform.x_um) > kMaxTranslationUm ||
        std::abs(transform.y_um) > kMaxTranslationUm) {
      return fail(ErrorCode::bad_data,
                  "directive {}: member {} stands twice or its transform is not rigid",
                  directive.epoch, to_string(*key));
    }
  }
  return {};
}

}  // namespace lifeline::sharing
