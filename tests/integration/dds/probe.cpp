// lifeline-dds-probe: one participant as a process of its own, for the tests of this folder.
// Writes one JSON object a line to stdout.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "common/base/log.hpp"
#include "common/base/stop_signal.hpp"
#include "common/dds/channel.hpp"
#include "tests/integration/dds/probe_samples.hpp"

namespace {

using namespace lifeline;
using Json = nlohmann::json;
using std::chrono::steady_clock;

struct Options {
  std::uint32_t domain = 0;
  std::string qos = LIFELINE_SOURCE_DIR "/config/qos/loopback.xml";
  std::string id = "probe";
  std::uint32_t tiles = 0;
  std::uint64_t revisions = 1;
  std::size_t size = 1000;
  std::uint64_t epoch = 0;
  bool standby = false;
  std::uint32_t peers = 0;
  bool repeat = false;
  double seconds = 20.0;
};

void print(const Json& json) {
  std::printf("%s\n", json.dump().c_str());
  std::fflush(stdout);
}

/// For results that must be there for the probe to make sense.
template <typename T>
T need(Result<T> result) {
  if (!result) {
    print({{"error", result.error().text}});
    std::exit(1);
  }
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

std::uint64_t resident_kb() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) / 1024;
}

double ms_since(steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(steady_clock::now() - start).count();
}

class Deadline {
 public:
  explicit Deadline(double seconds) : end_(steady_clock::now() + from_seconds(seconds)) {}
  [[nodiscard]] bool open() const { return !stop_requested() && steady_clock::now() < end_; }

 private:
  steady_clock::time_point end_;
};

/// Writes tiles and a directive, says so, and stays.
void publish(const Options& options, dds::Participant& participant) {
  const auto tiles = need(dds::make_outbox<wire::TsdTile>(participant));
  const auto directives = need(dds::make_outbox<wire::MergeDirective>(
      participant, options.standby ? dds::Standing::standby : dds::Standing::primary));
  const auto start = steady_clock::now();
  for (std::uint64_t revision = 1; revision <= options.revisions; ++revision) {
    for (std::uint32_t i = 0; i < options.tiles; ++i) {
      need(tiles->put(probe::tile(options.id, i, revision, options.size)));
    }
  }
  if (options.epoch > 0) need(directives->put(probe::directive(options.id, options.epoch)));
  print({{"event", "written"},
         {"ms", ms_since(start)},
         {"bytes_sent", participant.bytes_sent()},
         {"rss_kb", resident_kb()}});
  const Deadline deadline(options.seconds);
  while (deadline.open()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (options.repeat) need(directives->put(probe::directive(options.id, options.epoch)));
  }
}

Json describe(const wire::TsdTile& tile) {
  return {{"topic", "tsd_tile"},       {"sender", tile.envelope.sender_id},
          {"x", tile.tile_x},          {"y", tile.tile_y},
          {"revision", tile.revision}, {"intact", tile.payload == probe::payload(tile)}};
}

/// Prints what arrives. Says when the expected tiles (and, if asked for, the directive) are there,
/// and listens half a second longer for what should not come.
void collect(const Options& options, dds::Participant& participant) {
  const auto start = steady_clock::now();
  const auto tiles = need(dds::make_inbox<wire::TsdTile>(participant));
  const auto directives = need(dds::make_inbox<wire::MergeDirective>(participant));
  std::set<std::pair<std::int32_t, std::int32_t>> keys;
  std::uint64_t samples = 0, epoch = 0;
  double first_ms = 0.0, last_ms = 0.0;
  const Deadline deadline(options.seconds);
  auto done_at = steady_clock::time_point::max();
  while (deadline.open() && steady_clock::now() < done_at) {
    participant.wait_for_data(std::chrono::milliseconds(100));
    for (const auto& tile : tiles->take()) {
      if (samples++ == 0) first_ms = ms_since(start);
      last_ms = ms_since(start);
      keys.emplace(tile.tile_x, tile.tile_y);
      if (options.tiles <= 1000) print(describe(tile));
    }
    for (const auto& directive : directives->take()) {
      epoch = std::max(epoch, directive.epoch);
      print({{"topic", "merge_directive"},
             {"sender", directive.envelope.sender_id},
             {"epoch", directive.epoch}});
    }
    const bool complete = keys.size() >= options.tiles && epoch >= options.epoch;
    if (complete && done_at == steady_clock::time_point::max()) {
      done_at = steady_clock::now() + std::chrono::milliseconds(500);
    }
  }
  print({{"event", "summary"},
         {"samples", samples},
         {"keys", keys.size()},
         {"refused", tiles->refused() + directives->refused()},
         {"first_ms", first_ms},
         {"last_ms", last_ms},
         {"rss_kb", resident_kb()}});
}

/// Says hello ten times a second and counts whom it hears; stays until stopped, so that others can.
void meet(const Options& options, dds::Participant& participant) {
  const auto start = steady_clock::now();
  const auto out = need(dds::make_outbox<wire::AgentStatus>(participant));
  const auto in = need(dds::make_inbox<wire::AgentStatus>(participant));
  std::set<std::string> heard;
  bool said = false;
  wire::AgentStatus status;
  status.envelope.sender_id = status.agent_id = options.id;
  const Deadline deadline(options.seconds);
  while (deadline.open()) {
    ++status.envelope.sequence;
    need(out->put(status));
    const auto next = steady_clock::now() + std::chrono::milliseconds(100);
    while (steady_clock::now() < next) {
      participant.wait_for_data(next - steady_clock::now());
      for (const auto& peer : in->take()) heard.insert(peer.agent_id);
    }
    if (!said && heard.size() >= options.peers) {
      said = true;
      print({{"event", "met"},
             {"peers", heard.size()},
             {"ms", ms_since(start)},
             {"rss_kb", resident_kb()}});
    }
  }
  print({{"event", "summary"}, {"peers", heard.size()}, {"refused", in->refused()}});
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("One DDS participant, for tests");
  app.require_subcommand(1);
  app.add_option("--domain", options.domain)->required();
  app.add_option("--qos", options.qos);
  app.add_option("--id", options.id);
  app.add_option("--tiles", options.tiles, "how many tiles to write or wait for");
  app.add_option("--revisions", options.revisions, "how often each tile is written");
  app.add_option("--size", options.size, "payload of a tile in octets");
  app.add_option("--epoch", options.epoch, "of the directive to write or wait for; 0: none");
  app.add_flag("--standby", options.standby, "write the directive as the standby coordinator");
  app.add_flag("--repeat", options.repeat, "write the directive again, 20 times a second");
  app.add_option("--peers", options.peers, "how many to meet");
  app.add_option("--seconds", options.seconds, "how long to stay at most");
  auto* const publishing = app.add_subcommand("publish")->fallthrough();
  auto* const collecting = app.add_subcommand("collect")->fallthrough();
  app.add_subcommand("meet")->fallthrough();
  CLI11_PARSE(app, argc, argv);
  watch_stop_signals();
  set_up_log(options.id, "info");
  const auto participant =
      need(dds::Participant::create({options.domain, options.qos, options.id}));
  if (publishing->parsed()) {
    publish(options, *participant);
  } else if (collecting->parsed()) {
    collect(options, *participant);
  } else {
    meet(options, *participant);
  }
  return 0;
}
