#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "common/sharing/fused_map.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::test {

/// What the checker sees of one machine.
struct MachineView {
  std::string id;
  int life = 0;  ///< counts its starts
  const sharing::ReplicaStore& store;
  Epoch epoch;
  const sharing::FusedMap& common_map;
};

/// Watches a fleet from outside and writes down what must never happen (docs/architecture.md, the
/// rules that make sharing safe). Shares no code with what it watches but the fusion, which it does
/// anew from nothing.
class FleetChecker {
 public:
  /// `coarse`: what is published stands for what was shown, and is not the same.
  explicit FleetChecker(bool coarse = false) : coarse_(coarse) {}

  /// A helmet's mapper hands a tile over: only such contents may ever be published.
  void shown(const LayerKey& layer, TileIndex tile, const QuantisedTile& cells);

  /// After every step of a machine.
  void look(const MachineView& machine);

  /// Once nothing has happened for long: everybody alive holds the same, and it is what the newest
  /// tiles and the newest directive make. `expected`: of every layer whose owner is alive, what was
  /// shown last.
  void at_rest(const std::vector<MachineView>& machines, const wire::MergeDirective& newest,
               const std::map<LayerKey, std::map<TileIndex, QuantisedTile>>& expected);

  /// Whether at_rest() would find everybody equal.
  [[nodiscard]] static bool all_equal(const std::vector<MachineView>& machines, Epoch newest);

  [[nodiscard]] const std::vector<std::string>& violations() const { return violations_; }

 private:
  using Content = std::uint64_t;
  struct Held {
    Revision revision;
    const QuantisedTile* cells;
  };
  struct Life {
    std::map<std::pair<LayerKey, TileIndex>, Held> held;
    Epoch epoch;
  };

  void look_at_tile(const MachineView& machine, const LayerKey& layer, TileIndex tile,
                    const sharing::ReplicaTile& held, Life& life);
  [[nodiscard]] bool was_shown(const LayerKey& layer, TileIndex tile,
                               const QuantisedTile& published) const;
  void check_common_map(const MachineView& machine, const wire::MergeDirective& newest);
  template <typename... Parts>
  void violate(const Parts&... parts);

  bool coarse_;
  std::set<std::tuple<LayerKey, TileIndex, Content>> shown_;
  std::map<std::pair<LayerKey, TileIndex>, std::vector<QuantisedTile>> shown_cells_;  ///< if coarse
  std::map<std::tuple<LayerKey, TileIndex, Revision>, Content> contents_;
  std::map<std::pair<std::string, int>, Life> lives_;
  std::vector<std::string> violations_;
};

}  // namespace lifeline::test
