#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "common/base/result.hpp"
#include "coordinator/coordinator.hpp"
#include "coordinator/dashboard/feed.hpp"
#include "coordinator/dashboard/observer.hpp"
#include "coordinator/dashboard/server.hpp"
#include "coordinator/dashboard/timeline.hpp"

namespace lifeline::dashboard {

/// A coordinator's page: tells it what the coordinator sees, and the coordinator what its commander
/// decides. In the coordinator's thread; the server has its own.
class Dashboard {
 public:
  /// Before the coordinator's first step; it must outlive this. Errors as of Server::open.
  [[nodiscard]] static Result<std::unique_ptr<Dashboard>> open(const ListenAddress& listen,
                                                               Coordinator& coordinator,
                                                               double cell_size_m, double area_m2);
  /// With other files, for tests.
  [[nodiscard]] static Result<std::unique_ptr<Dashboard>> open(ServerOptions options,
                                                               Coordinator& coordinator);

  /// After each step of the coordinator.
  void step(SteadyTime now);

  // Of a recording: then nothing else is ordered.

  /// Where in the recording the page is.
  void show(const Timeline& timeline);
  /// What somebody wants of it, the newest wish; nothing where nobody said anything since.
  [[nodiscard]] std::optional<Steer> take_steer() { return std::exchange(steer_, std::nullopt); }
  /// Tells everything at the next step, whatever was told when.
  void refresh() { observer_->refresh(); }
  /// From now on at another coordinator, before its first step; the one of before must still be
  /// there.
  void look_at(Coordinator& coordinator);

  [[nodiscard]] const Server& server() const { return *server_; }

 private:
  explicit Dashboard(Coordinator& coordinator);
  [[nodiscard]] Result<void> follow(const ClientRequest& request);

  Coordinator* coordinator_;
  Feed feed_;
  std::optional<Observer> observer_;
  bool is_recording_ = false;
  std::optional<Steer> steer_;
  std::uint32_t beats_ = 0;
  std::chrono::steady_clock::time_point beat_due_{};
  std::unique_ptr<Server> server_;
};

/// Where to look, for people: the address, and with tokens one for each role.
[[nodiscard]] std::string describe(const Server& server);

}  // namespace lifeline::dashboard
