#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>

#include "common/base/result.hpp"
#include "tests/bench/radio/radio_net.hpp"

namespace lifeline::bench {

/// What the frames that some hosts of a radio net send are made of, as heard on the air, before any
/// is lost: octets by topic and kind of RTPS submessage. Listens in a thread of its own.
class RadioTraffic {
 public:
  /// By what a frame is for: a topic's name or "discovery", and "data", "data again", "heartbeat",
  /// "acknack", "gap" or "other". A frame's headers count to the first of its submessages.
  using Tally = std::map<std::string, std::uint64_t>;

  /// Listens to frames of `hosts` from here on. unavailable, with the reason, where it may not.
  [[nodiscard]] static Result<std::unique_ptr<RadioTraffic>> listen(const RadioNet& net,
                                                                    const std::set<int>& hosts);
  ~RadioTraffic();
  RadioTraffic(const RadioTraffic&) = delete;
  RadioTraffic& operator=(const RadioTraffic&) = delete;

  /// What was heard so far. Ends the listening.
  [[nodiscard]] Tally stop();

 private:
  explicit RadioTraffic(int socket) : socket_(socket) {}
  void hear();

  int socket_;
  std::set<int> interfaces_;
  std::atomic<bool> stopping_{false};
  Tally tally_;  ///< the thread's, until it has ended
  std::thread thread_;
};

}  // namespace lifeline::bench
