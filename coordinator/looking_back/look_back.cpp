#include "coordinator/looking_back/look_back.hpp"

#include <atomic>
#include <thread>

#include <sys/resource.h>
#include <unistd.h>

#include "common/base/log.hpp"
#include "coordinator/looking_back/recording_player.hpp"

namespace lifeline {
namespace {

// The mission has the processor first, and the page of who looks at it.
constexpr int kNiceness = 10;

class RecordedPast final : public dashboard::LookBack {
 public:
  RecordedPast(MissionRecording& recording, dashboard::Feed& feed)
      : recording_(recording),
        feed_(feed),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  void end() override { thread_.request_stop(); }
  [[nodiscard]] std::optional<std::string> ended() const override {
    if (!has_ended_) return std::nullopt;
    return why_;
  }

 private:
  void run(const std::stop_token& stop) {
    const QuietLog quiet;  // the mission has said it already
    (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
    if (const auto played = play(stop); !played) why_ = played.error().text;
    has_ended_ = true;
  }

  [[nodiscard]] Result<void> play(const std::stop_token& stop) {
    dashboard::Timeline begun;
    begun.is_mission_live = true;
    begun.is_paused = true;  // until it is told where to go
    auto player =
        RecordingPlayer::open([this] { return Replay::open(recording_.so_far()); }, feed_, begun);
    if (!player) return forward_error(player);
    while (!stop.stop_requested()) {
      if (auto turned = (*player)->turn(); !turned) return turned;
    }
    return {};
  }

  MissionRecording& recording_;
  dashboard::Feed& feed_;
  std::string why_;  // before has_ended_
  std::atomic<bool> has_ended_{false};
  std::jthread thread_;  // last: joined before what it uses goes away
};

}  // namespace

dashboard::OpenLookBack look_back_at(MissionRecording* recording) {
  return [recording](dashboard::Feed& feed) -> Result<std::unique_ptr<dashboard::LookBack>> {
    if (recording == nullptr) {
      return fail(ErrorCode::unavailable,
                  "nothing is recorded, so there is nothing to look back at; start the coordinator "
                  "with --record FOLDER, or give recording.folder in its configuration");
    }
    return std::make_unique<RecordedPast>(*recording, feed);
  };
}

}  // namespace lifeline
