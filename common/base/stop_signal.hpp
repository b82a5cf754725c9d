#pragma once

namespace lifeline {

/// Makes SIGINT and SIGTERM ask the program to finish in good order. Call once, before any thread
/// starts.
void watch_stop_signals();

/// Whether one of them came.
[[nodiscard]] bool stop_requested();

}  // namespace lifeline
