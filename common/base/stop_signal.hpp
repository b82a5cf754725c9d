#pragma once

#include <stop_token>
#include <thread>

namespace lifeline {

/// Makes SIGINT and SIGTERM ask the program to finish in good order. Call once, before any thread
/// starts.
void watch_stop_signals();

/// Whether one of them came.
[[nodiscard]] bool stop_requested();

/// The same as a token, for what waits: requested at most 20 ms after the signal came.
class StopOnSignal {
 public:
  StopOnSignal();
  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::jthread watch_;  // last: it requests the stop
};

}  // namespace lifeline
