#include "tests/support/fleet_checker.hpp"

#include <algorithm>
#include <sstream>

#include "common/sharing/accept.hpp"

namespace lifeline::test {
namespace {

// FNV-1a; the fleet itself hashes with SHA-256.
std::uint64_t content_of(const QuantisedTile& cells) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&hash](std::uint8_t octet) { hash = (hash ^ octet) * 1099511628211ULL; };
  for (const QuantisedCell& cell : cells) {
    add(static_cast<std::uint8_t>(cell.tsd));
    add(cell.weight);
  }
  return hash;
}

/// Whether a coarse cell may stand for a fine one: near enough, by what docs/decisions/0109 says.
bool stands_for(QuantisedCell coarse, QuantisedCell fine) {
  if (fine.weight == 0) return coarse == QuantisedCell{};
  if (coarse.weight != 1 && coarse.weight != 6) return false;
  switch (coarse.tsd) {
    case -32:
      return fine.tsd <= -14;
    case -10:
      return fine.tsd >= -29 && fine.tsd <= 5;
    case 10:
      return fine.tsd >= -4 && fine.tsd <= 29;
    case 32:
      return fine.tsd >= 14 && fine.tsd <= 95;
    case 127:
      return fine.tsd >= 64;
    default:
      return false;
  }
}

bool stands_for(const QuantisedTile& published, const QuantisedTile& shown, bool coarse) {
  if (!coarse) return published == shown;
  return std::ranges::equal(published, shown,
                            [](QuantisedCell a, QuantisedCell b) { return stands_for(a, b); });
}

std::string name(const LayerKey& layer, TileIndex tile) {
  std::ostringstream text;
  text << to_string(layer) << " (" << tile.x << ", " << tile.y << ")";
  return text.str();
}

// The members of the machine's group: a helmet's is the one that it stands in, the coordinator
// shows the largest.
std::vector<sharing::Placement> group_of(const MachineView& machine,
                                         const wire::MergeDirective& directive) {
  int group = -1;
  for (const auto& member : directive.members) {
    if (member.layer.agent_id == machine.id &&
        member.layer.map_id == static_cast<std::uint32_t>(machine.life))
      group = member.group;
  }
  if (machine.id == "coordinator") group = 0;
  std::vector<sharing::Placement> members;
  for (const auto& member : directive.members) {
    if (member.group == group)
      members.push_back({sharing::to_layer_key(member.layer).value(), member.T_common_map});
  }
  return members;
}

}  // namespace

template <typename... Parts>
void FleetChecker::violate(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  violations_.push_back(text.str());
}

void FleetChecker::shown(const LayerKey& layer, TileIndex tile, const QuantisedTile& cells) {
  shown_.emplace(layer, tile, content_of(cells));
  if (coarse_) shown_cells_[{layer, tile}].push_back(cells);
}

bool FleetChecker::was_shown(const LayerKey& layer, TileIndex tile,
                             const QuantisedTile& published) const {
  if (!coarse_) return shown_.contains({layer, tile, content_of(published)});
  const auto shown = shown_cells_.find({layer, tile});
  return shown != shown_cells_.end() &&
         std::ranges::any_of(shown->second, [&](const QuantisedTile& cells) {
           return stands_for(published, cells, true);
         });
}

void FleetChecker::look(const MachineView& machine) {
  Life& life = lives_[{machine.id, machine.life}];
  if (machine.epoch < life.epoch) {
    violate(machine.id, " went back from epoch ", life.epoch.value, " to ", machine.epoch.value);
  }
  life.epoch = machine.epoch;
  std::size_t seen = 0;
  for (const auto& [layer, tiles] : machine.store.layers()) {
    seen += tiles.size();
    for (const auto& [tile, held] : tiles) look_at_tile(machine, layer, tile, held, life);
  }
  if (seen < life.held.size()) violate(machine.id, " lost tiles that it held");
}

void FleetChecker::look_at_tile(const MachineView& machine, const LayerKey& layer, TileIndex tile,
                                const sharing::ReplicaTile& held, Life& life) {
  Held& before = life.held[{layer, tile}];
  if (before.revision == held.revision && before.cells == held.cells.get()) return;
  if (held.revision < before.revision) {
    violate(machine.id, " went back from revision ", before.revision.value, " to ",
            held.revision.value, " of ", name(layer, tile));
  } else if (held.revision == before.revision) {
    violate(machine.id, " took in revision ", held.revision.value, " of ", name(layer, tile),
            " twice");
  }
  before = {held.revision, held.cells.get()};
  const Content content = content_of(*held.cells);
  const auto known = contents_.find({layer, tile, held.revision});
  if (layer.agent_id.text() == machine.id && known == contents_.end()) {
    contents_[{layer, tile, held.revision}] = content;
    if (!was_shown(layer, tile, *held.cells))
      violate(machine.id, " published what its mapper never saw in ", name(layer, tile));
  } else if (known == contents_.end()) {
    violate(machine.id, " holds revision ", held.revision.value, " of ", name(layer, tile),
            ", which was never published");
  } else if (known->second != content) {
    violate("two contents of ", name(layer, tile), " bear revision ", held.revision.value);
  }
}

bool FleetChecker::all_equal(const std::vector<MachineView>& machines, Epoch newest) {
  const auto& first = machines.front().store;
  for (const MachineView& machine : machines) {
    if (machine.epoch != newest || machine.store.layers().size() != first.layers().size())
      return false;
    for (const auto& [layer, tiles] : first.layers()) {
      const auto* theirs = machine.store.find(layer);
      if (theirs == nullptr ||
          !std::ranges::equal(
              tiles, *theirs, {},
              [](const auto& t) { return std::pair(t.first, t.second.revision); },
              [](const auto& t) { return std::pair(t.first, t.second.revision); })) {
        return false;
      }
    }
  }
  return true;
}

void FleetChecker::at_rest(const std::vector<MachineView>& machines,
                           const wire::MergeDirective& newest,
                           const std::map<LayerKey, std::map<TileIndex, QuantisedTile>>& expected) {
  if (!all_equal(machines, Epoch{newest.epoch}))
    violate("machines do not hold the same tiles and directive after a quiet time");
  for (const MachineView& machine : machines) {
    for (const auto& [layer, tiles] : expected) {
      for (const auto& [tile, cells] : tiles) {
        const auto* held = machine.store.find(layer);
        if (held == nullptr || !held->contains(tile) ||
            !stands_for(*held->at(tile).cells, cells, coarse_))
          violate(machine.id, " does not hold the newest of ", name(layer, tile));
      }
    }
    check_common_map(machine, newest);
  }
}

void FleetChecker::check_common_map(const MachineView& machine,
                                    const wire::MergeDirective& newest) {
  sharing::FusedMap anew(machine.store.geometry());
  anew.place(group_of(machine, newest), machine.store);
  anew.update(machine.store);
  if (anew.sha256() != machine.common_map.sha256())
    violate(machine.id, "'s common map is not what its tiles and the directive make");
}

}  // namespace lifeline::test
