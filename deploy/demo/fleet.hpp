#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "common/base/time.hpp"
#include "deploy/demo/child_process.hpp"
#include "deploy/demo/fleet_plan.hpp"
#include "deploy/demo/programs.hpp"

namespace lifeline::demo {

/// What all processes of one demo have in common.
struct Mission {
  Programs programs;
  std::filesystem::path report;  ///< folder
  std::string mission_id;
  std::uint32_t domain_id = 0;
  double time_limit_s = 0.0;  ///< for the coordinator
};

/// Their command lines.
[[nodiscard]] ChildCommand coordinator_command(const Mission& mission, std::size_t helmets);
[[nodiscard]] ChildCommand helmet_command(const Mission& mission, const HelmetPlan& helmet);

/// A coordinator and its helmets as running processes. None outlives this object.
class Fleet {
 public:
  /// Starts the coordinator, then the helmets.
  [[nodiscard]] static Result<Fleet> start(const Mission& mission, const FleetPlan& plan);

  enum class End { coordinator_done, asked_to_stop };

  /// Waits until the coordinator ends or somebody asks us to stop. unavailable, with the helmet's
  /// last words, when a helmet ends by itself, and when the coordinator outstays its time limit.
  [[nodiscard]] Result<End> wait(SignalWatch& signals);

  /// Asks everybody to end, helmets first, and waits until they have; kills those that take longer
  /// than `patience`, or all when asked to stop once more.
  void stop(SignalWatch& signals, Duration patience);

  /// After stop(): a sentence for each helmet that failed as it ended, or had to be killed.
  [[nodiscard]] std::vector<std::string> bad_ends();

  /// The coordinator's exit status, once it has ended.
  [[nodiscard]] std::optional<int> coordinator_status() { return coordinator_.process.ended(); }

 private:
  struct Member {
    std::string name;
    std::filesystem::path log;
    ChildProcess process;
  };

  Fleet(Member coordinator, SteadyTime deadline)
      : coordinator_(std::move(coordinator)), deadline_(deadline) {}
  [[nodiscard]] Result<void> check_helmets();
  [[nodiscard]] bool all_ended();

  Member coordinator_;
  std::vector<Member> helmets_;
  SteadyTime deadline_;
};

}  // namespace lifeline::demo
