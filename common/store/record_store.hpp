#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "common/base/time.hpp"
#include "common/store/record_file.hpp"

namespace lifeline::store {

struct RecordStoreConfig {
  Duration commit_interval = std::chrono::milliseconds(50);  ///< between two commits, at least
  Duration retry_interval = std::chrono::seconds(5);         ///< after the disk refused
  Duration give_up_after =
      std::chrono::seconds(2);  ///< a commit that lasts longer is not waited for
};

/// Writes records behind everybody's back: put() hands over and returns, a thread of its own
/// commits whatever has come together, all at once. Of a record that changes faster than the disk
/// takes it, only the newest content is written; so what waits is never more than the state itself.
///
/// A disk that refuses ends nothing: the line says so, the newest content of each record is kept in
/// memory, and it is tried again every few seconds. Thread-safe.
class RecordStore {
 public:
  /// Makes the content when it is written, on the writing thread; empty: take the record away.
  using Content = std::function<std::optional<std::string>()>;
  using Ticket = std::uint64_t;

  explicit RecordStore(RecordFile file, RecordStoreConfig config = {});
  /// Writes what is left, if the disk takes it.
  ~RecordStore();
  RecordStore(const RecordStore&) = delete;
  RecordStore& operator=(const RecordStore&) = delete;

  /// Hands over a record's new content. Never waits for the disk.
  Ticket put(std::string key, Content content);
  Ticket put(std::string key, std::string content);
  /// Several that are committed together or not at all.
  using Batch = std::map<std::string, Content>;
  Ticket put(Batch batch);

  /// Everything up to this ticket need not be waited for any more: it is on disk, or the disk
  /// refuses or hangs.
  [[nodiscard]] Ticket settled() const;
  /// The newest ticket given.
  [[nodiscard]] Ticket newest() const;
  /// The disk takes what it is given.
  [[nodiscard]] bool works() const;
  /// Waits until all that was handed over so far is settled.
  void flush();

 private:
  void write_on(const std::stop_token& stop);
  void write_batch(std::unique_lock<std::mutex>& lock);
  void note_outcome(const FileResult<void>& written);

  RecordStoreConfig config_;
  RecordFile file_;  // the writing thread's alone
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  Batch pending_;
  Ticket newest_ = 0;
  Ticket committed_ = 0;
  bool works_ = true;
  bool flushing_ = false;
  std::optional<SteadyTime> writing_since_;
  std::jthread thread_;  // last: joined before what it uses goes away
};

}  // namespace lifeline::store
