#include "agents/run_command.hpp"

#include <cstdio>
#include <stop_token>
#include <thread>

#include <fmt/format.h>

#include "agents/agent_settings.hpp"
#include "agents/helmet_report.hpp"
#include "agents/helmet_threads.hpp"
#include "agents/sharing/mission_join.hpp"
#include "agents/sources/open_source.hpp"
#include "agents/sources/source_spec.hpp"
#include "common/base/config_folder.hpp"
#include "common/base/log.hpp"
#include "common/base/stop_signal.hpp"
#include "common/dds/open_channel.hpp"
#include "common/files/report_folder.hpp"
#include "idl/config.pb.h"

namespace lifeline {
namespace {

constexpr Duration kLoopWait = std::chrono::milliseconds(20);
constexpr Duration kJoinListen = std::chrono::milliseconds(1500);
// Long enough for the holder of a contested id to hear of it.
constexpr Duration kLingerAfterRefusal = std::chrono::milliseconds(500);

Result<proto::AgentConfig> read_config(const AgentRunOptions& options) {
  auto config = read_agent_config(options.config, options.matcher);
  if (!config) return config;
  if (options.mission) config->mutable_mission()->set_mission_id(*options.mission);
  if (options.domain) config->mutable_mission()->set_domain_id(*options.domain);
  return config;
}

// A sensor's newest scan is worth more than its oldest; a file played without pace must lose
// nothing.
Overflow overflow_of(const std::string& source) {
  const auto spec = sources::parse_source_spec(source);
  return spec && spec->text("rate", "real") == "max" ? Overflow::wait : Overflow::drop_oldest;
}

Result<sharing::HelmetChannels> open_channels(dds::Participant& participant) {
  sharing::HelmetChannels channels;
  Result<void> all;
  dds::open_outbox(participant, channels.pose, all);
  dds::open_outbox(participant, channels.scan, all);
  dds::open_outbox(participant, channels.tile, all);
  dds::open_outbox(participant, channels.status, all);
  dds::open_inbox(participant, channels.tiles, all);
  dds::open_inbox(participant, channels.directives, all);
  dds::open_inbox(participant, channels.statuses, all);
  if (!all) return forward_error(all);
  channels.bytes_sent = [&participant] { return participant.bytes_sent(); };
  return channels;
}

Result<MapId> join(const sharing::Speaker& speaker, Floor floor, sharing::HelmetChannels& channels,
                   dds::Participant& participant, const Clock& clock) {
  sharing::MissionJoin joining(speaker, floor, kJoinListen, *channels.status, *channels.statuses,
                               clock);
  while (!stop_requested()) {
    if (auto answer = joining.step()) {
      if (!*answer) std::this_thread::sleep_for(kLingerAfterRefusal);
      return *std::move(answer);
    }
    participant.wait_for_data(kLoopWait);
  }
  return fail(ErrorCode::unavailable, "stopped before the mission was joined");
}

// Exchanges what both halves have for each other until a signal comes.
void share(HelmetThreads& threads, Mailbox& mailbox, sharing::HelmetSharing& helmet,
           bool match_working_map, dds::Participant& participant) {
  bool told = false;
  while (!stop_requested() && !threads.source_error()) {
    participant.wait_for_data(kLoopWait);
    if (auto mapped = mailbox.take_mapped()) {
      helmet.put(mapped->tiles);
      helmet.put(std::move(mapped->state));
    }
    helmet.step();
    if (auto peers = helmet.take_peer_update(); peers && match_working_map)
      mailbox.put_peers(*peers);
    if (threads.finished() && !std::exchange(told, true)) {
      spdlog::info("the source gave its last scan; still sharing, stop with Ctrl-C");
    }
  }
}

Result<void> run(const AgentRunOptions& options) {
  auto id = AgentId::parse(options.id);
  if (!id) return forward_error(id);
  auto config = read_config(options);
  if (!config) return forward_error(config);
  set_up_log(options.id, config->mission().log_level());
  if (options.report) {
    if (auto ready = files::prepare_report_folder(*options.report); !ready) return ready;
  }
  std::stop_source stop_source;
  auto source = sources::open_source_with_attitude(options.source, options.attitude,
                                                   sources::kRealTime, stop_source.get_token());
  if (!source) return forward_error(source);
  auto qos = dds::qos_file(options.qos, options.config, config->mission().qos_profiles());
  if (!qos) return forward_error(qos);
  auto participant = dds::Participant::create({config->mission().domain_id(), *qos, options.id});
  if (!participant) return forward_error(participant);
  auto channels = open_channels(**participant);
  if (!channels) return forward_error(channels);

  const SystemClock clock;
  const sharing::Speaker speaker{*id, config->mission().mission_id(), random_incarnation()};
  const Floor floor{static_cast<std::int16_t>(config->floor())};
  auto map_id = join(speaker, floor, *channels, **participant, clock);
  if (!map_id) return forward_error(map_id);

  const AgentSettings settings = to_settings(*config);
  const LayerKey layer{*id, *map_id, floor};
  HelmetMapper mapper(settings.slam, settings.geometry, settings.projection);
  Mailbox mailbox;
  sharing::HelmetSharing helmet({speaker, layer, settings.geometry, settings.publisher},
                                *std::move(channels), clock);
  HelmetThreads threads(*std::move(source), overflow_of(options.source), mapper, mailbox);
  share(threads, mailbox, helmet, settings.match_working_map, **participant);
  stop_source.request_stop();
  threads.stop();
  if (options.report) {
    if (auto written =
            write_helmet_report(*options.report, layer, mapper, threads.scans_dropped(), helmet);
        !written) {
      return written;
    }
  }
  if (auto error = threads.source_error()) return tl::unexpected<Error>(*error);
  return {};
}

}  // namespace

int run_agent_command(const AgentRunOptions& options) {
  watch_stop_signals();
  if (auto done = run(options); !done) {
    fmt::print(stderr, "lifeline-agent: {}\n", done.error().text);
    return done.error().code == ErrorCode::wrong_use ? 2 : 1;
  }
  return 0;
}

}  // namespace lifeline
