#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/base/result.hpp"
#include "coordinator/dashboard/feed.hpp"

namespace lifeline::dashboard {

/// One page's look at an earlier time of a mission that goes on: fills a feed, and takes the page's
/// Steer from it, in a thread of its own.
class LookBack {
 public:
  /// Ends it, and waits for its thread.
  virtual ~LookBack() = default;

  /// Asks it to end; does not wait.
  virtual void end() = 0;
  /// Why it ended, for people, or empty where it was asked to; nothing while it goes on. From any
  /// thread.
  [[nodiscard]] virtual std::optional<std::string> ended() const = 0;

 protected:
  LookBack() = default;
  LookBack(const LookBack&) = default;
  LookBack& operator=(const LookBack&) = default;
};

/// Begins one, without waiting for the disk; the feed outlives it. An error says why there is
/// nothing to look at, and what to do.
using OpenLookBack = std::function<Result<std::unique_ptr<LookBack>>(Feed&)>;

}  // namespace lifeline::dashboard
