#include "common/store/record_store.hpp"

#include <utility>
#include <vector>

#include "common/base/log.hpp"

namespace lifeline::store {
namespace {

SteadyTime now() {
  return std::chrono::steady_clock::now();
}

std::vector<RecordChange> contents_of(const RecordStore::Batch& batch) {
  std::vector<RecordChange> changes;
  changes.reserve(batch.size());
  for (const auto& [key, content] : batch) changes.push_back({key, content()});
  return changes;
}

}  // namespace

RecordStore::RecordStore(RecordFile file, RecordStoreConfig config)
    : config_(config),
      file_(std::move(file)),
      thread_([this](const std::stop_token& stop) { write_on(stop); }) {}

RecordStore::~RecordStore() {
  thread_.request_stop();
  thread_.join();
}

RecordStore::Ticket RecordStore::put(std::string key, Content content) {
  std::lock_guard lock(mutex_);
  pending_.insert_or_assign(std::move(key), std::move(content));
  changed_.notify_all();
  return ++newest_;
}

RecordStore::Ticket RecordStore::put(std::string key, std::string content) {
  return put(std::move(key), [content = std::move(content)] { return std::optional(content); });
}

RecordStore::Ticket RecordStore::put(Batch batch) {
  std::lock_guard lock(mutex_);
  batch.merge(std::move(pending_));  // what is put now is newer
  pending_ = std::move(batch);
  changed_.notify_all();
  return ++newest_;
}

RecordStore::Ticket RecordStore::settled() const {
  std::lock_guard lock(mutex_);
  const bool hangs = writing_since_ && now() - *writing_since_ > config_.give_up_after;
  return works_ && !hangs ? committed_ : newest_;
}

RecordStore::Ticket RecordStore::newest() const {
  std::lock_guard lock(mutex_);
  return newest_;
}

bool RecordStore::works() const {
  std::lock_guard lock(mutex_);
  return works_;
}

void RecordStore::flush() {
  std::unique_lock lock(mutex_);
  const Ticket wanted = newest_;
  flushing_ = true;
  changed_.notify_all();
  changed_.wait_for(lock, config_.give_up_after, [&] { return committed_ >= wanted || !works_; });
  flushing_ = false;
}

void RecordStore::write_on(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    changed_.wait(lock, stop, [&] { return !pending_.empty(); });
    if (pending_.empty()) break;
    write_batch(lock);
    // Whatever comes meanwhile goes with the next commit.
    const Duration pause = works_ ? config_.commit_interval : config_.retry_interval;
    changed_.wait_for(lock, stop, pause, [&] { return flushing_ && works_; });
  }
  if (!pending_.empty()) write_batch(lock);
}

void RecordStore::write_batch(std::unique_lock<std::mutex>& lock) {
  Batch batch = std::exchange(pending_, {});
  const Ticket ticket = newest_;
  writing_since_ = now();
  lock.unlock();
  const auto written = file_.write(contents_of(batch));
  lock.lock();
  writing_since_.reset();
  if (written) {
    committed_ = ticket;
  } else {
    pending_.merge(std::move(batch));  // what was put meanwhile is newer
  }
  note_outcome(written);
  changed_.notify_all();
}

void RecordStore::note_outcome(const FileResult<void>& written) {
  if (written.has_value() == works_) return;
  works_ = written.has_value();
  if (works_) {
    spdlog::info("{}: can be written again; nothing is missing", file_.path().string());
  } else {
    spdlog::error(
        "{} -- the mission goes on from memory: until this is mended, a restart loses what comes "
        "now",
        written.error().text);
  }
}

}  // namespace lifeline::store
