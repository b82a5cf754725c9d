#include "agents/run_command.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "agents/agent_settings.hpp"
#include "agents/channel_settings.hpp"
#include "agents/helmet_report.hpp"
#include "agents/helmet_threads.hpp"
#include "agents/map_journal.hpp"
#include "agents/run_settings.hpp"
#include "agents/sharing/mission_join.hpp"
#include "agents/sources/open_source.hpp"
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

// A number that no map of this helmet has had.
MapId choose_map(MapId unused, HelmetStorage* storage) {
  if (storage == nullptr) return unused;
  return std::max(unused, MapId{storage->memory().last_map + 1});
}

struct Welcome {
  MapId unused_map;
  std::uint64_t statuses_said = 0;
};

Result<Welcome> join(const sharing::Speaker& speaker, Floor floor,
                     sharing::HelmetChannels& channels, dds::Participant& participant,
                     const Clock& clock) {
  sharing::MissionJoin joining(speaker, floor, kJoinListen, *channels.status, *channels.statuses,
                               clock);
  while (!stop_requested()) {
    if (auto answer = joining.step()) {
      if (*answer) return Welcome{**answer, joining.announced()};
      std::this_thread::sleep_for(kLingerAfterRefusal);
      return forward_error(*answer);
    }
    participant.wait_for_data(kLoopWait);
  }
  return fail(ErrorCode::unavailable, "stopped before the mission was joined");
}

/// What is told of each step.
struct Listeners {
  HelmetStorage* storage;  ///< nullptr: nothing is kept
  hud::HudFeed& hud;
  HelmetRecording* recording;  ///< nullptr: nothing is recorded
};

// Exchanges what both halves have for each other until a signal comes.
void share(HelmetThreads& threads, Mailbox& mailbox, sharing::HelmetSharing& helmet,
           bool match_working_map, const Listeners& listeners, dds::Participant& participant) {
  bool told = false;
  while (!stop_requested() && !threads.source_error()) {
    participant.wait_for_data(kLoopWait);
    if (auto mapped = mailbox.take_mapped()) {
      helmet.put(mapped->tiles, mapped->scanned_at);
      listeners.hud.pass(mapped->tiles);
      helmet.put(std::move(mapped->state));
    }
    helmet.step();
    if (listeners.storage != nullptr) listeners.storage->step(helmet);
    if (listeners.recording != nullptr) listeners.recording->step(helmet);
    if (auto peers = helmet.take_peer_update()) {
      listeners.hud.pass(*peers);
      if (match_working_map) mailbox.put_peers(*peers);
    }
    listeners.hud.step(helmet, std::chrono::steady_clock::now());
    if (threads.finished() && !std::exchange(told, true)) {
      spdlog::info("the source gave its last scan; still sharing, stop with Ctrl-C");
    }
  }
}

/// The mapping half at work. Where it goes on in a map it does not wait until the mission is
/// joined.
class Mapping {
 public:
  explicit Mapping(const AgentSettings& settings)
      : mapper(settings.slam, settings.geometry, settings.projection) {}

  void begin(std::unique_ptr<sensing::ScanSource> source, Overflow overflow, const LayerKey& layer,
             HelmetStorage* storage) {
    HelmetThreads::Keep keep;
    if (storage != nullptr) {
      storage->begin(layer);
      keep = storage->keep();
      if (auto memory = std::exchange(storage->memory().mapper, {}))
        mapper.resume(*std::move(memory));
    }
    threads.emplace(std::move(source), overflow, mapper, mailbox, std::move(keep));
  }

  HelmetMapper mapper;
  Mailbox mailbox;
  std::optional<HelmetThreads> threads;  ///< last: ended before what they use goes away
};

/// Tells a source that can wait to stop, whatever the reason.
struct StopAtEnd {
  std::stop_source& source;
  ~StopAtEnd() { source.request_stop(); }
};

// Shares until a signal or the source's error.
Result<void> share_map(const AgentRunOptions& options, const AgentSettings& settings,
                       const sharing::HelmetSharingConfig& config, sharing::HelmetChannels channels,
                       Mapping& mapping, Beside& beside, std::stop_source& stop_source,
                       dds::Participant& participant, const Clock& clock) {
  HelmetStorage* const storage = beside.storage.get();
  if (storage != nullptr) storage->attach(channels);
  std::optional<HelmetRecording> recording;
  if (beside.recording) {
    recording.emplace(*beside.recording, config, clock);
    recording->attach(channels);
  }
  sharing::HelmetSharing helmet(config, std::move(channels), clock);
  beside.hud.attach(helmet);
  if (storage != nullptr) {
    if (auto resumed = storage->attach(helmet); !resumed) return resumed;
  }
  std::optional<MapJournal> journal;
  if (options.journal) {
    auto opened = MapJournal::open(*options.journal);
    if (!opened) return forward_error(opened);
    journal = *std::move(opened);
    journal->attach(helmet);
  }
  share(*mapping.threads, mapping.mailbox, helmet, settings.match_working_map,
        {storage, beside.hud, recording ? &*recording : nullptr}, participant);
  helmet.finish();
  stop_source.request_stop();
  mapping.threads->stop();
  const Result<void> recorded = recording ? recording->finish(helmet) : Result<void>{};
  if (options.report) {
    if (auto written = write_helmet_report(*options.report, config.layer, mapping.mapper,
                                           mapping.threads->scans_dropped(), helmet);
        !written)
      return written;
  }
  if (auto error = mapping.threads->source_error()) return tl::unexpected<Error>(*error);
  return recorded;
}

Result<void> run(const AgentRunOptions& options) {
  auto id = AgentId::parse(options.id);
  if (!id) return forward_error(id);
  auto config = read_run_config(options);
  if (!config) return forward_error(config);
  set_up_log(options.id, config->mission().log_level());
  if (options.report) {
    if (auto ready = files::prepare_report_folder(*options.report); !ready) return ready;
  }
  const SystemClock clock;
  const sharing::Speaker speaker{*id, config->mission().mission_id(), random_incarnation()};
  const AgentSettings settings = to_settings(*config);
  LayerKey layer{*id, MapId{}, Floor{static_cast<std::int16_t>(config->floor())}};
  std::stop_source stop_source;
  auto source = sources::open_source_with_attitude(options.source, options.attitude,
                                                   sources::kRealTime, stop_source.get_token());
  if (!source) return forward_error(source);
  auto qos = dds::qos_file(options.qos, options.config, config->mission().qos_profiles());
  if (!qos) return forward_error(qos);
  auto beside = open_beside(options, *config, speaker, layer.floor, clock);
  if (!beside) return forward_error(beside);
  HelmetStorage* const storage = beside->storage.get();
  Mapping mapping(settings);
  const StopAtEnd stop{stop_source};
  const Overflow overflow = overflow_of(options.source);
  if (storage != nullptr && storage->memory().map) {
    layer.map_id = *storage->memory().map;
    mapping.begin(*std::move(source), overflow, layer, storage);
  }
  auto participant = dds::Participant::create({config->mission().domain_id(), *qos, options.id});
  if (!participant) return forward_error(participant);
  auto channels = open_channels(**participant, config->sharing().interface(), options.hud.wanted());
  if (!channels) return forward_error(channels);
  const auto welcome = join(speaker, layer.floor, *channels, **participant, clock);
  if (!welcome) return forward_error(welcome);
  if (!mapping.threads) {
    layer.map_id = choose_map(welcome->unused_map, storage);
    mapping.begin(*std::move(source), overflow, layer, storage);
  }
  spdlog::info("joined mission {} with map {}", speaker.mission_id, layer.map_id.value);
  return share_map(options, settings,
                   {speaker, layer, settings.geometry, settings.publisher, settings.budget_bit_s,
                    welcome->statuses_said},
                   *std::move(channels), mapping, *beside, stop_source, **participant, clock);
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
