#pragma once

#include <array>
#include <functional>
#include <memory>

#include "common/sharing/fused_map.hpp"
#include "tests/bench/paper/paper_cases.hpp"

namespace lifeline::bench {

/// Two rescuers in one process, without network: what each maps, what they exchange once they are
/// merged, and the map that both make.
class Team {
 public:
  explicit Team(Method method);

  /// Both walk; after each pair of scans `seen` is told the time since the start, in seconds.
  void play(const PaperWalk& walk, const std::function<void(double)>& seen);

  /// From now on the layers lie on each other by T_map1_map2; each helmet matches against both
  /// (Eq. 8-10) with its own weight `w_T1`, brought up to date once a second. A weight of 1: no
  /// update.
  void merge(const Pose2& T_map1_map2, double w_T1);

  [[nodiscard]] const HelmetMapper& helmet(std::size_t which) const { return *helmets_[which]; }
  [[nodiscard]] const TsdGrid& layer(std::size_t which) const { return helmets_[which]->layer(); }

  /// Both layers as they are now, in the first one's frame.
  [[nodiscard]] TsdGrid merged(const Pose2& T_map1_map2);

 private:
  void publish();
  void exchange();

  Method method_;
  std::array<std::unique_ptr<HelmetMapper>, 2> helmets_;
  std::array<LayerKey, 2> layers_;
  std::uint64_t revision_ = 0;
  sharing::ReplicaStore store_;
  std::array<sharing::FusedMap, 2> peers_;
  double own_weight_ = 1.0;
};

}  // namespace lifeline::bench
