#pragma once

#include <string_view>

#include "common/base/ids.hpp"
#include "common/base/result.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

/// Whether a sample may be looked at at all: our protocol version, our mission, a sender with a
/// valid name. A sample of another mission is refused like a broken one: neither may touch what we
/// hold.
[[nodiscard]] Result<void> check_envelope(const wire::Envelope& envelope,
                                          std::string_view mission_id);

/// The layer that a sample names, once its agent id is valid.
[[nodiscard]] Result<LayerKey> to_layer_key(const wire::LayerName& name);
[[nodiscard]] wire::LayerName to_layer_name(const LayerKey& key);

/// Checks envelope, name, sender and numbers of a helmet's pose; the layer in whose map frame it
/// lies.
[[nodiscard]] Result<LayerKey> check_pose(const wire::HelmetPose& pose,
                                          std::string_view mission_id);

/// Checks what a directive claims: members at most, each a valid layer that stands in it once,
/// rotations that are rotations (cos^2 + sin^2 = 1 within 1e-6), translations within 2 km, w_T1 in
/// [0, 1].
[[nodiscard]] Result<void> check_directive(const wire::MergeDirective& directive);

/// Whether a directive replaces another one: of a larger epoch, or of the same where two
/// coordinators that did not hear each other both wrote one; then every machine decides alike.
[[nodiscard]] bool outranks(const wire::MergeDirective& one, const wire::MergeDirective& other);

/// Whether of two statuses with one epoch and the same tiles each tells other members, or another
/// common map. Where both speak of the same group of layers, they follow two directives of that
/// epoch.
[[nodiscard]] bool holds_another_map(const wire::AgentStatus& one, const wire::AgentStatus& other);

/// Whether an epoch that somebody speaks of can be true for who knows `known`: no mission has a
/// million directives, and an epoch far ahead would shut up every coordinator there is.
[[nodiscard]] bool is_believable(Epoch heard, Epoch known);

}  // namespace lifeline::sharing
