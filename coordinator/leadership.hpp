#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "common/base/time.hpp"
#include "common/wire/messages.hpp"

namespace lifeline {

struct LeadershipConfig {
  bool standby = false;  ///< leads only while no primary does
  /// Listens so long before it leads: for what others have said, and whether they still lead.
  Duration listen = std::chrono::seconds(2);
  Duration standby_listen = std::chrono::seconds(4);
  Duration silent_after = std::chrono::milliseconds(2500);  ///< of another coordinator, status 1 Hz
};

/// Which of several coordinators writes the directive: a primary before a standby, of two alike the
/// one whose name and incarnation come first, and whoever leads before one that has just come. How
/// it stands, a coordinator says by the state in its status: tracking where a primary leads, weak
/// where a standby does, starting where it follows. A state machine on somebody else's clock.
class Leadership {
 public:
  Leadership(LeadershipConfig config, std::string id, std::uint64_t incarnation, SteadyTime now)
      : config_(config), own_(std::move(id), incarnation), since_(now) {}

  /// Takes in another coordinator's status, a process of the same id included.
  void hear(const wire::AgentStatus& status, SteadyTime now);
  /// Somebody wrote a newer answer than ours, unheard by us: listen first.
  void yield(SteadyTime now);
  /// Whether to lead from now on.
  bool step(SteadyTime now);

  [[nodiscard]] bool leads() const { return leads_; }
  [[nodiscard]] wire::AgentState state() const;
  /// Who leads instead, for people; empty where nobody is known to.
  [[nodiscard]] std::string leader() const;

 private:
  using Name = std::pair<std::string, std::uint64_t>;
  enum class Part { follows, stands_in, leads };
  struct Other {
    Part part;
    SteadyTime heard_at;
  };
  static constexpr std::size_t kMostOthers = 16;

  [[nodiscard]] bool gives_way_to(const Name& name, const Other& other) const;

  LeadershipConfig config_;
  Name own_;
  SteadyTime since_;
  bool leads_ = false;
  std::map<Name, Other> others_;
};

}  // namespace lifeline
