#pragma once

#include <stop_token>
#include <thread>

namespace lifeline {

/// Makes SIGINT and SIGTERM ask the program to finish in good order. Call once, before any thread
/// starts.
void watch_stop_signals();

/// Whether one of them came.
[[nodiscard]] bool stop_requested();

/// Requests a stop of `stop` soon after one of them came, for what waits on a stop token. Ends when
/// the thread is joined.
[[nodiscard]] std::jthread pass_on_stop_signal(std::stop_source stop);

}  // namespace lifeline
