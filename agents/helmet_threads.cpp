#include "agents/helmet_threads.hpp"

#include <utility>

#include "common/base/log.hpp"

namespace lifeline {
namespace {

constexpr std::size_t kQueuedScans = 8;
constexpr Duration kWaitForScan = std::chrono::milliseconds(100);
// Below a lidar's usual 100 ms: each of its scans is handed over as soon as it is mapped.
constexpr Duration kLeastBetweenHandOvers = std::chrono::milliseconds(50);
// With the wait for a scan within half a second.
constexpr Duration kSilentAfter = std::chrono::milliseconds(400);

}  // namespace

HelmetThreads::HelmetThreads(std::unique_ptr<sensing::ScanSource> source, Overflow overflow,
                             HelmetMapper& mapper, Mailbox& mailbox, Keep keep)
    : source_(std::move(source)),
      mapper_(mapper),
      mailbox_(mailbox),
      keep_(std::move(keep)),
      scans_(kQueuedScans, overflow),
      mapper_thread_([this] { map_scans(); }),
      source_thread_([this](const std::stop_token& stop) { read_source(stop); }) {}

HelmetThreads::~HelmetThreads() {
  stop();
}

void HelmetThreads::stop() {
  source_thread_.request_stop();
  scans_.close();
  if (source_thread_.joinable()) source_thread_.join();
  if (mapper_thread_.joinable()) mapper_thread_.join();
}

std::optional<Error> HelmetThreads::source_error() const {
  std::lock_guard lock(error_mutex_);
  return source_error_;
}

void HelmetThreads::read_source(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    auto scan = source_->next();
    if (!scan) {
      spdlog::error("{}", scan.error().text);
      std::lock_guard lock(error_mutex_);
      source_error_ = scan.error();
      break;
    }
    if (!scan->has_value() || !scans_.push({**std::move(scan), std::chrono::steady_clock::now()}))
      break;
  }
  scans_.close();
}

void HelmetThreads::map_scans() {
  SteadyTime hand_over_due{}, last_scan = std::chrono::steady_clock::now();
  while (!scans_.finished()) {
    if (auto peers = mailbox_.take_peers()) mapper_.apply(*peers);
    const auto taken = scans_.pop(kWaitForScan);
    const SteadyTime now = std::chrono::steady_clock::now();
    if (taken) {
      mapper_.step(taken->scan);
      if (oldest_mapped_ == SteadyTime{}) oldest_mapped_ = taken->at;
      last_scan = now;
    }
    mapper_.set_lidar_health(now - last_scan > kSilentAfter ? wire::SensorHealth::silent
                                                            : wire::SensorHealth::good);
    if (now < hand_over_due) continue;
    hand_over_due = now + kLeastBetweenHandOvers;
    hand_over(false);
  }
  mapper_.finish();
  hand_over(true);
  finished_ = true;
}

void HelmetThreads::hand_over(bool finished) {
  sharing::HelmetState state = mapper_.state();
  state.scans_dropped += scans_.dropped();
  if (finished) state.state = wire::AgentState::finished;
  if (keep_) keep_(mapper_, state);
  mailbox_.put(mapper_.take_changed_tiles(), std::move(state), std::exchange(oldest_mapped_, {}));
}

}  // namespace lifeline
