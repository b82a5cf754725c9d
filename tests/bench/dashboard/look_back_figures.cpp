#include "tests/bench/dashboard/look_back_figures.hpp"

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include "common/recording/recorded_so_far.hpp"
#include "common/recording/topic_names.hpp"
#include "common/sharing/fixed_transform.hpp"
#include "coordinator/looking_back/recording_player.hpp"
#include "tests/support/sharing_samples.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::bench {
namespace {

constexpr std::size_t kMostWaiting = 10'000;
constexpr int kRecordedHelmets = 8;
constexpr int kTicksAMinute = 600;
constexpr int kTicksARecordedTile = 5;  // each helmet sends two tiles a second ...
constexpr int kTilesAPlace = 20;        // ... and sees a new one every ten

std::string name_of(int helmet) {
  return fmt::format("helmet-{:02}", helmet);
}

/// Rooms of 3 m whose walls move a little with each revision.
QuantisedTile rooms(std::uint64_t revision) {
  QuantisedTile cells;
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; ++x) {
      const int to_wall = std::min(x % 60, y % 60) - static_cast<int>(revision % 3);
      cells[static_cast<std::size_t>(y * kTileSide + x)] = {
          static_cast<std::int8_t>(std::clamp(to_wall * 42, -127, 127)), 3};
    }
  }
  return cells;
}

/// A recording under way, and who writes it.
class RecordedDrill {
 public:
  RecordedDrill(bag::BagWriter writer, std::chrono::minutes length)
      : recorder_(std::move(writer), kMostWaiting) {
    put(ros2::Message{
        std::string(kRecordingTopic), std::string(ros2::kString),
        ros2::text(
            R"({"format":1,"recorder":"vehicle","mission_id":"drill","cell_size_m":0.05,"truncation_m":0.15})")});
    put_directive();
    const int ticks = static_cast<int>(length.count()) * kTicksAMinute;
    for (int tick = 0; tick < ticks; ++tick) {
      now_ += std::chrono::milliseconds(100);
      for (int helmet = 0; helmet < kRecordedHelmets; ++helmet) put_helmet(helmet, tick);
      while (recorder_.waiting() > kMostWaiting / 2)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    while (!recorder_.span() || recorder_.span()->last < now_)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  [[nodiscard]] Recorder& recorder() { return recorder_; }

 private:
  void put(Recordable what) { recorder_.put(now_, std::move(what)); }

  void put_directive() {
    wire::MergeDirective directive;
    directive.envelope = test::envelope("vehicle", 1);
    directive.mission_id = test::kMission;
    directive.epoch = 1;
    for (int helmet = 0; helmet < kRecordedHelmets; ++helmet) {
      wire::DirectiveMember member;
      member.layer = {name_of(helmet), 1, 0};
      member.T_common_map = sharing::to_fixed(Pose2{2.0 * helmet, 0.5 * helmet, 0.1 * helmet});
      directive.members.push_back(member);
    }
    put(Heard(std::move(directive)));
  }

  void put_helmet(int helmet, int tick) {
    const auto sequence = static_cast<std::uint64_t>(tick) + 1;
    wire::HelmetPose pose;
    pose.envelope = test::envelope(name_of(helmet), sequence);
    pose.agent_id = name_of(helmet);
    pose.map_id = 1;
    pose.T_map_head = {0.1 * tick, 1.0, 0.0};
    pose.trust_percent = 90;
    put(Heard(pose));
    if (tick % 10 == 0) {
      wire::AgentStatus status;
      status.envelope = test::envelope(name_of(helmet), sequence);
      status.agent_id = name_of(helmet);
      status.map_id = 1;
      put(Heard(status));
    }
    if (tick % kTicksARecordedTile != helmet % kTicksARecordedTile) return;
    const int seen = tick / kTicksARecordedTile;
    for (const auto& part :
         test::tile_samples(test::layer(name_of(helmet)), {seen / kTilesAPlace, helmet}, sequence,
                            rooms(sequence)))
      put(Heard(part));
  }

  Timestamp now_{std::chrono::hours(500'000)};
  Recorder recorder_;
};

double thread_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double resident_mb() {
  std::ifstream pages("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  pages >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// A page that looks back, without a browser.
class Looker {
 public:
  Looker(RecordingPlayer& player, dashboard::Feed& feed) : player_(player), feed_(feed) {}

  void go_to(Duration to, bool is_paused) {
    (void)feed_.put(dashboard::ClientOrder{1, {1, dashboard::Steer{is_paused, 1.0, to}}});
    bool may_turn = turn();
    while (may_turn && player_.timeline().is_seeking) may_turn = turn();
  }
  /// The share of a core that some seconds take.
  double share(std::chrono::seconds time) {
    const auto begun = std::chrono::steady_clock::now();
    const double spent_s = thread_cpu_s();
    while (std::chrono::steady_clock::now() < begun + time && turn()) {
    }
    return (thread_cpu_s() - spent_s) / to_seconds(std::chrono::steady_clock::now() - begun);
  }

 private:
  bool turn() {
    const bool turned = player_.turn().has_value();
    (void)feed_.take();
    return turned;
  }

  RecordingPlayer& player_;
  dashboard::Feed& feed_;
};

}  // namespace

LookBackFigures look_back_figures(std::chrono::minutes recorded) {
  const double nothing = std::nan("");
  const support::TemporaryFolder folder;
  auto writer = bag::BagWriter::create(folder.path() / "bag");
  if (!writer) return {nothing, nothing, nothing, nothing};
  RecordedDrill drill(*std::move(writer), recorded);
  dashboard::Feed feed;
  feed.set_watchers(1);
  dashboard::Timeline begun;
  begun.is_mission_live = begun.is_paused = true;
  const double before_mb = resident_mb();
  auto player = RecordingPlayer::open(
      [&] { return Replay::open(std::make_unique<RecordedSoFar>(drill.recorder())); }, feed, begun);
  if (!player) return {nothing, nothing, nothing, nothing};
  Looker looker(**player, feed);
  LookBackFigures figures;
  const auto left = std::chrono::steady_clock::now();
  looker.go_to(recorded, true);
  figures.way_s = to_seconds(std::chrono::steady_clock::now() - left);
  figures.memory_mb = resident_mb() - before_mb;
  figures.rest_share = looker.share(std::chrono::seconds(3));
  looker.go_to(recorded - std::chrono::minutes(1), false);
  figures.play_share = looker.share(std::chrono::seconds(10));
  return figures;
}

}  // namespace lifeline::bench
