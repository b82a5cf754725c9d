#include "agents/map_corrector.hpp"

#include <iterator>
#include <utility>

namespace lifeline {

MapCorrector::MapCorrector(slam::LoopCloser closer)
    : closer_(std::move(closer)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

MapCorrector::~MapCorrector() {
  thread_.request_stop();
  thread_.join();
}

void MapCorrector::put(std::vector<slam::Keyframe> keyframes) {
  if (keyframes.empty()) return;
  std::lock_guard lock(mutex_);
  std::move(keyframes.begin(), keyframes.end(), std::back_inserter(waiting_));
  changed_.notify_all();
}

std::optional<slam::MapCorrection> MapCorrector::take() {
  std::lock_guard lock(mutex_);
  return std::exchange(newest_, std::nullopt);
}

void MapCorrector::drain() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.empty() && !busy_; });
}

void MapCorrector::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
    std::vector<slam::Keyframe> keyframes = std::exchange(waiting_, {});
    busy_ = true;
    lock.unlock();
    std::optional<slam::MapCorrection> newest;
    for (slam::Keyframe& keyframe : keyframes) {
      if (stop.stop_requested()) break;
      if (auto correction = closer_.add(std::move(keyframe))) newest = std::move(correction);
    }
    lock.lock();
    if (newest) newest_ = std::move(newest);
    busy_ = false;
    changed_.notify_all();
  }
}

}  // namespace lifeline
