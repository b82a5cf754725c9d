#include "common/base/stop_signal.hpp"

#include <atomic>
#include <chrono>
#include <csignal>

namespace lifeline {
namespace {

std::atomic<bool> g_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

void on_signal(int) {
  g_stop.store(true);
}

}  // namespace

void watch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_requested() {
  return g_stop.load();
}

StopOnSignal::StopOnSignal()
    : watch_([stop = source_](const std::stop_token& over) mutable {
        while (!over.stop_requested() && !lifeline::stop_requested()) {
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        if (lifeline::stop_requested()) stop.request_stop();
      }) {}

}  // namespace lifeline
