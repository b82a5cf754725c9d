#pragma once

#include <memory>
#include <string>

#include "common/base/result.hpp"
#include "coordinator/coordinator.hpp"
#include "coordinator/dashboard/feed.hpp"
#include "coordinator/dashboard/observer.hpp"
#include "coordinator/dashboard/server.hpp"

namespace lifeline::dashboard {

/// What the page is told of a mission at the beginning.
struct MissionFacts {
  double cell_size_m = 0.05;
  double area_m2 = 0.0;  ///< 0: not known
};

/// The page as it is built into the program, for a coordinator's mission.
[[nodiscard]] ServerOptions page_options(const ListenAddress& listen,
                                         const sharing::Speaker& speaker,
                                         const MissionFacts& facts);

/// A running coordinator's page: tells it what the coordinator sees, and the coordinator what its
/// commander decides. In the coordinator's thread; the server has its own.
class Dashboard {
 public:
  /// Before the coordinator's first step; it must outlive this. Errors as of Server::open.
  [[nodiscard]] static Result<std::unique_ptr<Dashboard>> open(ServerOptions options,
                                                               Coordinator& coordinator);

  /// After each step of the coordinator.
  void step(SteadyTime now);

  [[nodiscard]] const Server& server() const { return *server_; }

 private:
  explicit Dashboard(Coordinator& coordinator);
  [[nodiscard]] Result<void> follow(const ClientRequest& request);

  Coordinator& coordinator_;
  Feed feed_;
  Observer observer_;
  std::unique_ptr<Server> server_;
};

/// Where to look, for people: the address, and with tokens one for each role.
[[nodiscard]] std::string describe(const Server& server);

}  // namespace lifeline::dashboard
