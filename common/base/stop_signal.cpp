#include "common/base/stop_signal.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <utility>

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

std::jthread pass_on_stop_signal(std::stop_source stop) {
  return std::jthread([stop = std::move(stop)](const std::stop_token& joined) mutable {
    std::mutex mutex;
    std::condition_variable_any never_notified;
    std::unique_lock lock(mutex);
    // A signal handler may wake nobody: it is looked for instead.
    while (!joined.stop_requested() && !stop_requested()) {
      never_notified.wait_for(lock, joined, std::chrono::milliseconds(20), [] { return false; });
    }
    if (stop_requested()) stop.request_stop();
  });
}

}  // namespace lifeline
