#pragma once

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "common/base/sha256.hpp"
#include "coordinator/coordinator.hpp"
#include "coordinator/dashboard/feed.hpp"
#include "coordinator/dashboard/frames.hpp"
#include "coordinator/dashboard/search_help.hpp"

namespace lifeline::dashboard {

/// Tells a Feed what a coordinator sees: tiles as they change, poses ten times a second, the rest
/// when it changes. In the coordinator's thread.
class Observer {
 public:
  /// Before the coordinator's first step. Both must outlive it.
  Observer(Coordinator& coordinator, Feed& feed);
  ~Observer();
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

  void step(SteadyTime now);
  /// Tells everything at the next step, whatever was told when.
  void refresh();
  /// Takes back every tile that was told, before another observer tells of another coordinator.
  void take_back();

 private:
  void put_tiles(SteadyTime now);
  void put_layers();
  void put_sections(SteadyTime now);
  void put_if_new(Section section, std::string frame);
  void number_helmets();

  Coordinator& coordinator_;
  Feed& feed_;
  std::set<TileIndex> changed_;  ///< of the common map
  std::map<LayerKey, std::map<TileIndex, std::shared_ptr<const QuantisedTile>>> put_;
  std::array<std::string, kSections> last_;
  Observed observed_;
  SearchHelp search_;
  bool is_hash_old_ = true;
  bool was_watched_ = false;
  SteadyTime tiles_due_{}, layers_due_{}, poses_due_{}, fleet_due_{}, lists_due_{}, trails_due_{};
};

}  // namespace lifeline::dashboard
