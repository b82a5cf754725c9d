#pragma once

#include <chrono>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "common/sharing/roster.hpp"

namespace lifeline::sharing {

/// Notices pairs of which one does not hear the other: those whom others hear but not we, and those
/// whom we hear but who do not hear us. Says so in the log, once as it begins and once as it ends.
/// One owner, not thread-safe.
class OneWayWatch {
 public:
  /// Longer than a helmet that has gone takes to be lost to everybody.
  static constexpr Duration kPatience = std::chrono::seconds(8);

  explicit OneWayWatch(AgentId self) : self_(std::move(self)) {}

  void step(SteadyTime now, const Roster& roster);

  /// Whom others hear and we do not, by name.
  [[nodiscard]] std::vector<std::string> unheard() const { return named(unheard_); }
  /// Whom we hear, but who do not hear us, by name.
  [[nodiscard]] std::vector<std::string> deaf() const { return named(deaf_); }

 private:
  struct Pair {
    SteadyTime since{};
    std::string by{};  ///< one of those who hear it
    bool told = false;
  };
  using Pairs = std::map<std::string, Pair>;
  enum class Side { unheard, deaf };

  void note(Pairs& pairs, const std::map<std::string, std::string>& found, Side side,
            SteadyTime now) const;
  [[nodiscard]] static std::vector<std::string> named(const Pairs& pairs);

  AgentId self_;
  Pairs unheard_, deaf_;
  SteadyTime review_due_{};
};

/// Of those present, who does not hear whom though that one is present too: pairs (who, whom), for
/// people who look on. Who has just come is not heard by everybody yet.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> one_way_pairs(const Roster& roster,
                                                                             SteadyTime now);

}  // namespace lifeline::sharing
