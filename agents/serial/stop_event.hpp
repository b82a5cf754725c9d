#pragma once

#include <functional>
#include <stop_token>

#include "agents/serial/file_descriptor.hpp"
#include "common/base/time.hpp"

namespace lifeline::serial {

/// A stop token as a descriptor that poll() wakes up from: readable from the request on, for good.
class StopEvent {
 public:
  explicit StopEvent(const std::stop_token& stop);

  /// Waits that long, or until the request.
  void wait(Duration duration) const;

  [[nodiscard]] bool requested() const { return stop_.stop_requested(); }
  /// -1, which poll() passes over, where the system has no descriptor left: a stop is then seen
  /// when the wait is over.
  [[nodiscard]] int descriptor() const { return event_.get(); }

 private:
  std::stop_token stop_;
  FileDescriptor event_;
  std::stop_callback<std::function<void()>> on_stop_;  // last: it uses the descriptor
};

}  // namespace lifeline::serial
