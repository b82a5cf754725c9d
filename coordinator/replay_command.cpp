#include "coordinator/replay_command.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/base/log.hpp"
#include "common/base/stop_signal.hpp"
#include "coordinator/progress.hpp"
#include "coordinator/recording/replay.hpp"
#include "coordinator/replay_page_command.hpp"

namespace lifeline {
namespace {

// How long a stop may take to be noticed.
constexpr Duration kLongestSleep = std::chrono::milliseconds(100);

/// Empty: as fast as it goes.
Result<std::optional<double>> read_speed(const std::string& text) {
  if (text == "max") return std::nullopt;
  double speed = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), speed);
  if (error != std::errc() || end != text.data() + text.size() || !(speed > 0.0) ||
      !std::isfinite(speed)) {
    return fail(ErrorCode::wrong_use, "--speed {}: give a number above 0, or max", text);
  }
  return speed;
}

/// Waits until that much of the recording is due.
void wait_for(Duration elapsed, double speed, SteadyTime started) {
  const auto due = started + from_seconds(to_seconds(elapsed) / speed);
  while (!stop_requested()) {
    const Duration left = due - std::chrono::steady_clock::now();
    if (left <= Duration{0}) return;
    std::this_thread::sleep_for(std::min(left, kLongestSleep));
  }
}

/// What became of it, in words.
const char* verdict(const Replay& replay) {
  if (!replay.facts().common_map_sha256) return "cut off";
  return *replay.facts().common_map_sha256 == replay.common_map_sha256() ? "same" : "differs";
}

nlohmann::ordered_json to_json(const Replay& replay, const std::string& bag) {
  nlohmann::ordered_json json;
  json["bag"] = bag;
  json["mission_id"] = replay.facts().mission_id;
  json["recorder"] = replay.facts().recorder;
  json["duration_s"] = to_seconds(replay.elapsed());
  json["messages"] = replay.messages();
  json["messages_refused"] = replay.refused();
  json["epoch"] = replay.coordinator().directive().epoch;
  json["layers"] = replay.coordinator().store().layers().size();
  json["detections"] = replay.coordinator().detections().size();
  json["common_map_sha256"] = replay.common_map_sha256();
  json["live_common_map_sha256"] = replay.facts().common_map_sha256.value_or("");
  json["outcome"] = verdict(replay);
  return json;
}

void print_outcome(const Replay& replay, const ReplayCommandOptions& options) {
  if (options.json) {
    fmt::print(
        "{}\n",
        to_json(replay, options.bag).dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
    return;
  }
  const std::string sha256 = replay.common_map_sha256();
  fmt::print("{:.1f} s of mission {}, {} messages{}\n", to_seconds(replay.elapsed()),
             replay.facts().mission_id, replay.messages(),
             replay.refused() > 0 ? fmt::format(", {} undecodable", replay.refused()) : "");
  fmt::print("common map: {}\n", sha256.empty() ? "none" : sha256);
  if (!replay.facts().common_map_sha256)
    fmt::print("the recording was cut off: what the mission came to is not known\n");
}

/// Shown on a page, which lives on at the recording's end.
Result<bool> run_page(const ReplayCommandOptions& options, std::optional<double> speed) {
  auto page = ReplayPage::open(options, speed);
  if (!page) return forward_error(page);
  bool is_same = true;
  const auto shown = (*page)->run([&](const Replay& at_end) {
    print_outcome(at_end, options);
    std::fflush(stdout);
    is_same = std::string_view(verdict(at_end)) != "differs";
  });
  if (!shown) return forward_error(shown);
  return is_same;
}

Result<bool> run(const ReplayCommandOptions& options) {
  const auto speed = read_speed(options.speed);
  if (!speed) return forward_error(speed);
  if (options.dashboard && *options.dashboard != "off") return run_page(options, *speed);
  auto opened = Replay::open(options.bag);
  if (!opened) return forward_error(opened);
  Replay& replay = **opened;
  ProgressPrinter progress(stdout, replay.steady_now());
  const SteadyTime started = std::chrono::steady_clock::now();
  while (!stop_requested()) {
    const auto more = replay.step();
    if (!more) return forward_error(more);
    if (!*more) break;
    if (*speed) wait_for(replay.elapsed(), **speed, started);
    if (*speed && !options.json) progress.step(replay.coordinator(), replay.steady_now());
  }
  print_outcome(replay, options);
  return stop_requested() || std::string_view(verdict(replay)) != "differs";
}

}  // namespace

int run_replay_command(const ReplayCommandOptions& options) {
  watch_stop_signals();
  set_up_log("replay", "warn");
  const auto same = run(options);
  if (!same) {
    fmt::print(stderr, "lifeline-coordinator: {}\n", same.error().text);
    return same.error().code == ErrorCode::wrong_use ? 2 : 1;
  }
  if (*same) return 0;
  fmt::print(stderr,
             "lifeline-coordinator: {}: comes to another common map than the mission did: messages "
             "are missing from it, or another version recorded it\n",
             options.bag);
  return 1;
}

}  // namespace lifeline
