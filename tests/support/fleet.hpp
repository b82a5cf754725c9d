#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "agents/helmet_mapper.hpp"
#include "agents/sensing/scan_source.hpp"
#include "common/wire/loopback.hpp"
#include "coordinator/coordinator.hpp"
#include "coordinator/settlement.hpp"

namespace lifeline::test {

/// A helmet without threads: source, mapping half and sharing half, stepped by hand.
class Helmet {
 public:
  Helmet(const std::string& id, std::unique_ptr<sensing::ScanSource> source, wire::LoopbackBus& bus,
         const Clock& clock);

  /// One scan, if the source has one left, then whatever sharing has to do.
  void step();

  [[nodiscard]] const HelmetMapper& mapper() const { return mapper_; }
  [[nodiscard]] const sharing::HelmetSharing& sharing() const { return sharing_; }
  [[nodiscard]] bool finished() const { return source_ == nullptr; }

 private:
  std::unique_ptr<sensing::ScanSource> source_;
  HelmetMapper mapper_;
  sharing::HelmetSharing sharing_;
};

/// Helmets and a coordinator in one thread, on one bus and one hand-driven clock: same inputs, same
/// bits.
class Fleet {
 public:
  /// One helmet a SOURCE, called "helmet0", "helmet1", ...
  explicit Fleet(const std::vector<std::string>& sources,
                 CoordinatorSettings settings = default_settings());

  /// Steps everybody each 100 ms of the clock until all hold the same map, or for `deadline` of the
  /// clock.
  Settlement run(Duration deadline);
  /// Steps everybody once, 100 ms on.
  void step();

  [[nodiscard]] const std::vector<std::unique_ptr<Helmet>>& helmets() const { return helmets_; }
  [[nodiscard]] const Coordinator& coordinator() const { return *coordinator_; }
  [[nodiscard]] static CoordinatorSettings default_settings();

 private:
  [[nodiscard]] bool finished() const;

  ManualClock clock_;
  wire::LoopbackBus bus_;
  InlineMatchWorker worker_{matching::MatchConfig{}};
  std::vector<std::unique_ptr<Helmet>> helmets_;
  std::unique_ptr<Coordinator> coordinator_;
};

/// Where a helmet's map truly lies in the world.
[[nodiscard]] Pose2 true_T_world_map(const HelmetMapper& mapper);

/// T_G as it truly is: where map b lies in map a, from where both helmets truly began.
[[nodiscard]] Pose2 true_T_a_b(const HelmetMapper& a, const HelmetMapper& b);

}  // namespace lifeline::test
