#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/base/time.hpp"
#include "deploy/demo/child_process.hpp"
#include "tests/bench/radio/pose_ages.hpp"
#include "tests/bench/radio/radio_net.hpp"

namespace lifeline::bench {

/// What the fleet's watch heard last of one machine.
struct HeardStatus {
  double heard_at_s = 0.0;  ///< wall clock
  bool helmet = false;
  bool finished = false;
  double explored_m2 = 0.0;
  std::string common_map_sha256;
  std::uint64_t scans = 0;
  std::uint64_t scans_dropped = 0;
  std::uint64_t samples_refused = 0;
  std::size_t tiles = 0;                 ///< that it holds, of all layers
  std::vector<std::string> peers_heard;  ///< others that it hears
};

/// The real programs on the hosts of a radio net: a coordinator on host 1, helmets on the next, and
/// on the last one `lifeline-coordinator watch`, by which everything is judged. Without a net, all
/// on this machine's loopback interface.
class RadioFleet {
 public:
  struct Options {
    std::filesystem::path programs;  ///< folder of lifeline-agent and lifeline-coordinator
    std::filesystem::path qos;
    std::filesystem::path folder;  ///< takes logs
    int helmets = 8;
    double walk_s = 60.0;
    bool coarse_tiles = true;
    std::string source_options = "beams=400";  ///< of the simulated walks
    std::uint32_t domain = 0;
    std::uint32_t budget_bit_s = 0;  ///< of a helmet; 0 = by default
    bool journals = false;           ///< NAME.journal of each helmet, in `folder`
  };

  [[nodiscard]] static Result<RadioFleet> start(RadioNet& net, const Options& options) {
    return start(&net, options);
  }
  [[nodiscard]] static Result<RadioFleet> start_here(const Options& options) {
    return start(nullptr, options);
  }

  /// Host of a helmet, helmets counted from 0.
  [[nodiscard]] static int host_of(int helmet) { return helmet + 2; }
  [[nodiscard]] Result<void> start_helmet(int helmet, const std::string& source);
  [[nodiscard]] static std::string name_of(int helmet);
  [[nodiscard]] std::filesystem::path journal_of(int helmet) const;
  /// What each walks unless told otherwise.
  [[nodiscard]] std::string source_of(int helmet) const;
  void kill_helmet(int helmet);
  void kill_coordinator();
  [[nodiscard]] Result<void> start_coordinator();

  /// Takes in what the watch has heard, for so long.
  void listen(Duration time);
  /// Until `done` says so, at most `limit`. Seconds it took; empty when it was not reached.
  template <typename Done>
  [[nodiscard]] std::optional<double> until(const Done& done, Duration limit) {
    const auto started = std::chrono::steady_clock::now();
    while (!done(*this)) {
      if (somebody_ended() || std::chrono::steady_clock::now() - started > limit)
        return std::nullopt;
      listen(std::chrono::milliseconds(100));
    }
    return to_seconds(std::chrono::steady_clock::now() - started);
  }

  /// All that run hold the same common map, by statuses that came after `since_s` (wall clock).
  [[nodiscard]] bool all_equal(double since_s = 0.0) const;
  [[nodiscard]] bool all_finished() const;
  /// Every helmet has told of scans.
  [[nodiscard]] bool all_walk() const;
  /// Everybody has told, in one status or another, of hearing each other: every pair is matched.
  [[nodiscard]] bool all_have_met() const;
  /// Everybody's newest status says that it hears everybody else: nobody is late just now.
  [[nodiscard]] bool all_hear_all() const;
  /// Another coordinator, on a host of its own: it follows, and holds nothing yet.
  [[nodiscard]] Result<void> start_standby();
  /// It holds as many tiles as the coordinator, and the same common map.
  [[nodiscard]] bool standby_holds_all() const;
  /// Ends all helmets in good order, and waits for that: what they wrote is whole then.
  void end_helmets();
  /// Proportional share of memory (PSS) of each machine's process, in MB.
  [[nodiscard]] std::map<std::string, double> memory_mb();
  [[nodiscard]] const std::map<std::string, HeardStatus>& heard() const { return heard_; }
  /// Each heard pose, by helmet, in order of arrival.
  [[nodiscard]] std::map<std::string, std::vector<HeardPose>> take_poses() {
    return std::exchange(poses_, {});
  }

 private:
  /// Whether all helmets have told a status, each of which `holds`.
  [[nodiscard]] bool all_helmets(const std::function<bool(const HeardStatus&)>& holds) const;

  RadioFleet(RadioNet* net, Options options) : net_(net), options_(std::move(options)) {}
  [[nodiscard]] static Result<RadioFleet> start(RadioNet* net, const Options& options);
  [[nodiscard]] Result<demo::ChildProcess> begin(int host, const std::string& name,
                                                 std::vector<std::string> arguments,
                                                 const std::string& program);
  void take_line(const std::string& line);
  [[nodiscard]] int last_host() const { return net_ == nullptr ? 0 : net_->hosts(); }
  [[nodiscard]] bool is_machine(const std::string& name) const;
  /// Nobody should: says who has, and where its log is.
  [[nodiscard]] bool somebody_ended();

  RadioNet* net_;  ///< nullptr: none
  Options options_;
  std::map<std::string, demo::ChildProcess> running_;
  std::ifstream watch_;
  std::string begun_line_;
  std::map<std::string, HeardStatus> heard_;
  std::map<std::string, std::set<std::string>> met_;  ///< whom each has ever told of hearing
  std::map<std::string, std::vector<HeardPose>> poses_;
};

[[nodiscard]] double wall_now_s();

}  // namespace lifeline::bench
