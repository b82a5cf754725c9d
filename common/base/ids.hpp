#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/base/result.hpp"

namespace lifeline {

/// A helmet's (or coordinator's) name: 1 to 32 characters out of a-z A-Z 0-9 _ - . ; unique in a
/// mission.
class AgentId {
 public:
  static constexpr std::size_t kMaxLength = 32;

  /// Checks `text`; the error says what is wrong with it.
  [[nodiscard]] static Result<AgentId> parse(std::string_view text);

  [[nodiscard]] const std::string& text() const { return text_; }
  auto operator<=>(const AgentId&) const = default;

 private:
  explicit AgentId(std::string_view text) : text_(text) {}
  std::string text_;
};

/// A strong integer: values of different tags do not mix.
template <typename Tag, typename Integer>
struct StrongInteger {
  Integer value{};
  auto operator<=>(const StrongInteger&) const = default;
};

using MapId =
    StrongInteger<struct MapIdTag, std::uint32_t>;  ///< grows each time an agent starts a new map
using Floor = StrongInteger<struct FloorTag, std::int16_t>;  ///< storey, 0 = ground; floors are
                                                             ///< never matched together
using Revision =
    StrongInteger<struct RevisionTag, std::uint64_t>;  ///< of one tile; 0 = never published
using Epoch =
    StrongInteger<struct EpochTag, std::uint64_t>;  ///< of the merge directive; 0 = none yet
using Incarnation =
    StrongInteger<struct IncarnationTag, std::uint64_t>;  ///< random, new at each start

/// Names one helmet's layer. The order is the one in which layers are fused (docs/decisions/0003).
struct LayerKey {
  AgentId agent_id;
  MapId map_id;
  Floor floor;
  auto operator<=>(const LayerKey&) const = default;
};

/// "alpha/1" or, off the ground floor, "alpha/1@-2": for messages to people.
[[nodiscard]] std::string to_string(const LayerKey& layer);

/// A fresh incarnation from the operating system's random source, never 0.
[[nodiscard]] Incarnation random_incarnation();

}  // namespace lifeline
