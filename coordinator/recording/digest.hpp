#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/base/time.hpp"
#include "common/recording/heard.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline {

/// What of a stretch of a mission still counts at its end: of each tile its newest whole revision
/// and what came behind it, of each helmet its way, its newest poses and status; directives,
/// finds and alerts all. Who hears that, in the same order, comes to the same state as who heard
/// everything (docs/decisions/0807). One owner, not thread-safe.
class Digest {
 public:
  struct Entry {
    Timestamp wall{};            ///< when it was recorded
    SteadyTime steady{};         ///< the same by the replay's steady clock
    std::optional<Heard> heard;  ///< nothing where something later took its place
  };

  /// `ways`: what the coordinator that will hear it has drawn of them.
  explicit Digest(const std::map<LayerKey, Coordinator::Path>& ways);

  /// In the order of time.
  void take(Timestamp wall, SteadyTime steady, Heard heard);

  /// What was taken, in the order of time.
  [[nodiscard]] const std::deque<Entry>& entries() const { return entries_; }

 private:
  using Place = std::size_t;  ///< in entries_
  using TileKey = std::tuple<wire::LayerName, std::int32_t, std::int32_t>;
  struct KeptTile {
    std::uint64_t whole_revision = 0;
    /// The parts held of this revision and of those behind it.
    std::map<std::uint64_t, std::map<std::uint8_t, Place>> parts;
  };
  struct KeptWay {
    std::optional<Eigen::Vector2d> last_m;  ///< of the points that are on the way
    std::deque<Place> recent;               ///< poses that draw nothing, the newest
  };

  /// Whether it is to be kept.
  bool note(const wire::HelmetPose& pose, Place place);
  bool note(const wire::AgentStatus& status, Place place);
  bool note(const wire::TsdTile& tile, Place place);
  void drop(Place place) { entries_[place].heard.reset(); }

  std::deque<Entry> entries_;
  std::map<TileKey, KeptTile> tiles_;
  std::map<wire::LayerName, KeptWay> ways_;
  std::map<std::pair<std::string, std::uint64_t>, Place> statuses_;  ///< by sender and incarnation
};

}  // namespace lifeline
