#include "coordinator/watch_command.hpp"

#include <cstdio>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "common/base/sha256.hpp"
#include "common/base/stop_signal.hpp"
#include "common/dds/open_channel.hpp"
#include "common/sharing/accept.hpp"
#include "coordinator/coordinator_settings.hpp"
#include "coordinator/watch_table.hpp"
#include "idl/config.pb.h"

namespace lifeline {
namespace {

constexpr Duration kTableWait = std::chrono::milliseconds(50);

struct Ears {
  std::unique_ptr<wire::Inbox<wire::AgentStatus>> statuses;
  std::unique_ptr<wire::Inbox<wire::HelmetPose>> poses;
};

Result<Ears> open_ears(dds::Participant& participant, bool poses) {
  Ears ears;
  Result<void> all;
  dds::open_inbox(participant, ears.statuses, all);
  if (poses) dds::open_inbox(participant, ears.poses, all);
  if (!all) return forward_error(all);
  return ears;
}

double wall_s(Timestamp time) {
  return to_seconds(time.time_since_epoch());
}

const char* recording_word(wire::RecordingState state) {
  switch (state) {
    case wire::RecordingState::off:
      return "off";
    case wire::RecordingState::on:
      return "on";
    case wire::RecordingState::failing:
      return "failing";
  }
  return "unknown";
}

std::size_t tiles_of(const wire::AgentStatus& status) {
  std::size_t tiles = 0;
  for (const auto& layer : status.layers) tiles += layer.tiles;
  return tiles;
}

class Watch {
 public:
  Watch(std::string mission_id, Ears ears, bool json)
      : mission_id_(std::move(mission_id)), ears_(std::move(ears)), json_(json) {}

  void step(const Clock& clock) {
    const SteadyTime now = clock.steady_now();
    for (const auto& status : ears_.statuses->take()) {
      if (!sharing::check_envelope(status.envelope, mission_id_) || !roster_.hear(status, now))
        continue;
      if (json_) print(status, clock.wall_now());
    }
    if (ears_.poses != nullptr) {
      for (const auto& pose : ears_.poses->take()) hear(pose, clock.wall_now());
    }
    if (!json_ && now >= table_due_) {
      table_due_ = now + std::chrono::seconds(1);
      // On a terminal over the last one; into a file or pipe one after the other.
      fmt::print("{}{}{}\n", isatty(STDOUT_FILENO) != 0 ? "\x1b[H\x1b[2J" : "",
                 watch_table(roster_, now), agreement(roster_, now));
      std::fflush(stdout);
    }
  }

 private:
  void hear(const wire::HelmetPose& pose, Timestamp now) {
    if (!sharing::check_envelope(pose.envelope, mission_id_)) return;
    const nlohmann::ordered_json line{
        {"pose", pose.agent_id},
        {"heard_at_s", wall_s(now)},
        {"sent_at_s", 1e-9 * static_cast<double>(pose.envelope.sent_at_ns)},
        {"x_m", pose.T_map_head.x_m},
        {"y_m", pose.T_map_head.y_m},
        {"trust_percent", pose.trust_percent}};
    print(line);
  }

  static void print(const wire::AgentStatus& status, Timestamp now) {
    const nlohmann::ordered_json line{
        {"status", status.agent_id},
        {"heard_at_s", wall_s(now)},
        {"sent_at_s", 1e-9 * static_cast<double>(status.envelope.sent_at_ns)},
        {"role", status.role == wire::Role::helmet ? "helmet" : "coordinator"},
        {"finished", status.state == wire::AgentState::finished},
        {"lost", status.state == wire::AgentState::lost},
        {"scans", status.scans},
        {"scans_dropped", status.scans_dropped},
        {"explored_m2", status.explored_m2},
        {"epoch", status.epoch_applied},
        {"fingerprint", to_hex(status.fingerprint)},
        {"common_map_sha256", to_hex(status.common_map_sha256)},
        {"layers", status.layers.size()},
        {"tiles", tiles_of(status)},
        {"tiles_behind", status.tiles_behind},
        {"bytes_sent", status.bytes_sent},
        {"samples_refused", status.samples_refused},
        {"recording", recording_word(status.recording)},
        {"samples_unrecorded", status.samples_unrecorded},
        {"peers_heard", status.peers_heard}};
    print(line);
  }

  // A name from the network may hold anything: what is no UTF-8 is replaced.
  static void print(const nlohmann::ordered_json& line) {
    fmt::print("{}\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    std::fflush(stdout);
  }

  std::string mission_id_;
  Ears ears_;
  bool json_;
  sharing::Roster roster_;
  SteadyTime table_due_{};
};

Result<void> run(const CoordinatorWatchOptions& options) {
  auto config = read_coordinator_config(options.config, options.mission, options.domain);
  if (!config) return forward_error(config);
  auto qos = dds::qos_file(options.qos, options.config, config->mission().qos_profiles());
  if (!qos) return forward_error(qos);
  auto participant = dds::Participant::create({config->mission().domain_id(), *qos, "watch"});
  if (!participant) return forward_error(participant);
  auto ears = open_ears(**participant, options.json);
  if (!ears) return forward_error(ears);
  const SystemClock clock;
  const SteadyTime started = clock.steady_now();
  Watch watch(config->mission().mission_id(), *std::move(ears), options.json);
  while (!stop_requested() && !(options.time_limit_s && clock.steady_now() - started >
                                                            from_seconds(*options.time_limit_s))) {
    (*participant)->wait_for_data(kTableWait);
    watch.step(clock);
  }
  return {};
}

}  // namespace

int run_watch_command(const CoordinatorWatchOptions& options) {
  watch_stop_signals();
  if (const auto done = run(options); !done) {
    fmt::print(stderr, "lifeline-coordinator: {}\n", done.error().text);
    return done.error().code == ErrorCode::wrong_use ? 2 : 1;
  }
  return 0;
}

}  // namespace lifeline
