#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "agents/helmet_mapper.hpp"
#include "agents/mailbox.hpp"
#include "agents/sensing/scan_source.hpp"
#include "common/base/bounded_queue.hpp"

namespace lifeline {

/// The two threads that turn a source's scans into a map: one reads the source, one owns the
/// mapper. They hand over through `mailbox`, which the sharing thread empties.
class HelmetThreads {
 public:
  /// `overflow`: what happens to scans that come faster than they can be mapped. `mapper` belongs
  /// to the mapping thread from here on, until stop() has returned.
  /// `keep`, on the mapping thread, sees mapper and state before each hand-over: to keep them
  /// through a restart.
  using Keep = std::function<void(const HelmetMapper&, const sharing::HelmetState&)>;
  HelmetThreads(std::unique_ptr<sensing::ScanSource> source, Overflow overflow,
                HelmetMapper& mapper, Mailbox& mailbox, Keep keep = {});
  ~HelmetThreads();

  /// Ends both threads and waits for them. The source must already have been told to stop if it can
  /// wait.
  void stop();

  /// The source gave its last scan and all were mapped.
  [[nodiscard]] bool finished() const { return finished_; }
  /// Why the source ended, if not by its end.
  [[nodiscard]] std::optional<Error> source_error() const;
  [[nodiscard]] std::size_t scans_dropped() const { return scans_.dropped(); }

 private:
  void read_source(const std::stop_token& stop);
  void map_scans();
  void hand_over(bool finished);

  std::unique_ptr<sensing::ScanSource> source_;
  HelmetMapper& mapper_;
  Mailbox& mailbox_;
  Keep keep_;
  struct Taken {
    sensing::RawScan scan;
    SteadyTime at;  ///< when the source gave it
  };
  BoundedQueue<Taken> scans_;
  SteadyTime oldest_mapped_{};  ///< scan that was not handed over yet; zero: none; mapping thread
  std::atomic<bool> finished_{false};
  mutable std::mutex error_mutex_;
  std::optional<Error> source_error_;
  std::jthread mapper_thread_;  // last: joined before what they use goes away
  std::jthread source_thread_;
};

}  // namespace lifeline
