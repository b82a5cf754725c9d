#include "tests/bench/dashboard/dashboard_bench.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <optional>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "coordinator/dashboard/page_assets.hpp"
#include "coordinator/dashboard/server.hpp"
#include "idl/dashboard.pb.h"
#include "tests/bench/command_line.hpp"
#include "tests/bench/dashboard/look_back_figures.hpp"
#include "tests/bench/report.hpp"

namespace lifeline::bench {
namespace {

namespace pb = proto::dashboard;
using dashboard::Feed;
using dashboard::Section;

constexpr int kTilesPerSide = 71;  // 5,041 tiles
constexpr int kCrowd = 50;
constexpr int kChangesPerTick = 25;  // each helmet sees half a tile anew, ten times a second
constexpr Duration kTick = std::chrono::milliseconds(100);

/// What measure.mjs does with the map, and what that is.
constexpr std::array<std::pair<const char*, const char*>, 5> kMotions{
    {{"rest", "whole map"},
     {"far_pan", "whole map, moved"},
     {"pan", "closer, moved"},
     {"turn", "closer, turned"},
     {"zoom", "closer, zoomed"}}};

struct DashboardOptions {
  std::optional<std::filesystem::path> out;
  int seconds = 20;
  int minutes = 10;
};

/// Rooms of 4 m with doors, as a lidar would see them; `seen` makes every look a little different.
std::shared_ptr<const sharing::FusedTile> tile_of(TileIndex tile, int seen) {
  auto cells = std::make_shared<sharing::FusedTile>();
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; ++x) {
      const int gx = (tile.x * kTileSide + x + 100'000) % 80,
                gy = (tile.y * kTileSide + y + 100'000) % 80;
      const bool door = (gx > 30 && gx < 50) || (gy > 30 && gy < 50);
      const int to_wall = door ? 9 : std::min({gx, gy, 80 - gx, 80 - gy}) - 1;
      const int tsd = std::clamp(to_wall * 42, -127, 127);
      const auto weight = static_cast<std::uint8_t>(1 + (x * 7 + y * 13 + seen) % 15);
      (*cells)[static_cast<std::size_t>(y * kTileSide + x)] = {static_cast<std::int8_t>(tsd),
                                                               weight};
    }
  }
  return cells;
}

std::string helmet_name(int i) {
  return fmt::format("helmet-{:02}", i);
}

std::string poses_at(double now_s) {
  pb::ServerFrame frame;
  frame.mutable_poses()->set_now_s(now_s);
  for (int i = 0; i < kCrowd; ++i) {
    auto& pose = *frame.mutable_poses()->add_poses();
    const double angle = 0.1 * now_s + 2.0 * std::numbers::pi * i / kCrowd;
    pose.set_agent_id(helmet_name(i));
    pose.set_x_m(static_cast<float>((20.0 + i) * std::cos(angle)));
    pose.set_y_m(static_cast<float>((20.0 + i) * std::sin(angle)));
    pose.set_yaw_rad(static_cast<float>(angle));
    pose.set_sigma_m(0.3F);
    pose.set_trust_percent(90);
    pose.set_heard_at_s(now_s);
  }
  return frame.SerializeAsString();
}

std::string fleet_at(double now_s) {
  pb::ServerFrame frame;
  auto& fleet = *frame.mutable_fleet();
  fleet.set_now_s(now_s);
  fleet.set_leads(true);
  fleet.set_common_map_sha256(std::string(32, 'x'));
  fleet.add_maps("");
  for (int i = 0; i < kCrowd; ++i) {
    auto& agent = *fleet.add_agents();
    agent.set_agent_id(helmet_name(i));
    agent.set_number(static_cast<std::uint32_t>(i + 1));
    agent.set_is_helmet(true);
    agent.set_state(pb::TRACKING);
    agent.set_heard_at_s(now_s);
    agent.set_explored_m2(100.0F + static_cast<float>(now_s));
    agent.set_is_in_common_map(true);
  }
  return frame.SerializeAsString();
}

std::string trails_at(double now_s) {
  pb::ServerFrame frame;
  for (int i = 0; i < kCrowd; ++i) {
    auto& trail = *frame.mutable_trails()->add_trails();
    trail.set_agent_id(helmet_name(i));
    for (int k = 0; k < 1000; ++k) {
      const double angle = 0.1 * now_s + 2.0 * std::numbers::pi * i / kCrowd - 0.005 * k;
      trail.add_points_cm(
          static_cast<int>(k == 0 ? 100 * (20.0 + i) * std::cos(angle) : 40 * std::sin(angle)));
      trail.add_points_cm(
          static_cast<int>(k == 0 ? 100 * (20.0 + i) * std::sin(angle) : -40 * std::cos(angle)));
    }
  }
  return frame.SerializeAsString();
}

TileIndex nth_tile(int n) {
  return {n % kTilesPerSide - kTilesPerSide / 2, n / kTilesPerSide - kTilesPerSide / 2};
}

double cpu_s(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The synthetic mission, in a thread of its own.
class Feeder {
 public:
  explicit Feeder(Feed& feed) : feed_(feed) {
    for (int i = 0; i < kTilesPerSide * kTilesPerSide; ++i)
      feed_.put(dashboard::TileChange{"", nth_tile(i), tile_of(nth_tile(i), 0)});
    feed_.flush();
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  [[nodiscard]] double spent_s() const { return spent_s_; }

 private:
  void run(const std::stop_token& stop) {
    auto next = std::chrono::steady_clock::now();
    for (int tick = 0; !stop.stop_requested(); ++tick) {
      const double now_s = 0.1 * tick;
      feed_.put(Section::poses, poses_at(now_s));
      if (tick % 5 == 0) feed_.put(Section::fleet, fleet_at(now_s));
      if (tick % 20 == 0) feed_.put(Section::trails, trails_at(now_s));
      for (int i = 0; i < kChangesPerTick; ++i) {
        const TileIndex tile =
            nth_tile((tick * kChangesPerTick + i * 197) % (kTilesPerSide * kTilesPerSide));
        feed_.put(dashboard::TileChange{"", tile, tile_of(tile, tick)});
      }
      feed_.flush();
      spent_s_ = cpu_s(CLOCK_THREAD_CPUTIME_ID);
      std::this_thread::sleep_until(next += kTick);
    }
  }

  Feed& feed_;
  std::atomic<double> spent_s_{0.0};
  std::jthread thread_;
};

/// The page's figures; a null object where the browser gave none.
nlohmann::json measure(const std::string& address, int seconds) {
  const std::string command = fmt::format(
      "'{}' '{}' '{}' '{}' '{}' {} {}", LIFELINE_NODE, LIFELINE_MEASURE, LIFELINE_BROWSER_PACKAGES,
      LIFELINE_CHROMIUM, address, kTilesPerSide * kTilesPerSide, seconds);
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string output;
  std::array<char, 4096> some{};
  while (const std::size_t n = std::fread(some.data(), 1, some.size(), pipe))
    output.append(some.data(), n);
  pclose(pipe);
  return nlohmann::json::parse(output, nullptr, false);
}

int run(const DashboardOptions& options) {
  Feed feed;
  dashboard::ServerOptions server_options;
  server_options.listen = {"127.0.0.1", 0};
  server_options.assets = dashboard::page_assets();
  server_options.greeting = {"bench", "vehicle", 1, 0.05, 60'000.0};
  auto server = dashboard::Server::open(std::move(server_options), feed);
  if (!server) {
    fmt::print(stderr, "lifeline bench: {}\n", server.error().text);
    return 1;
  }
  Feeder feeder(feed);
  const auto began = std::chrono::steady_clock::now();
  const double process_s = cpu_s(CLOCK_PROCESS_CPUTIME_ID), fed_s = feeder.spent_s();
  const auto page = measure(fmt::format("http://{}/", (*server)->listen().text()), options.seconds);
  const double wall_s = to_seconds(std::chrono::steady_clock::now() - began);
  const double served_s = cpu_s(CLOCK_PROCESS_CPUTIME_ID) - process_s - (feeder.spent_s() - fed_s);
  const auto figure = [&](const std::string& name) {
    return page.is_object() ? page.value(name, std::nan("")) : std::nan("");
  };
  using Side = Bar::Side;
  std::vector<ReportRow> rows{
      {"first tiles drawn after opening", figure("first_tiles_s"), "s", Bar{Side::at_most, 2.0}},
      {"all 5,041 tiles drawn", figure("whole_map_s"), "s"}};
  for (const auto& [motion, name] : kMotions) {
    const std::string key = motion;
    rows.push_back({fmt::format("frames, {}", name), figure(key + "_per_s"), "1/s",
                    Bar{Side::at_least, 30.0}});
    rows.push_back({fmt::format("a frame, {}: median", name), figure(key + "_median_ms"), "ms"});
    rows.push_back({fmt::format("a frame, {}: p99", name), figure(key + "_p99_ms"), "ms"});
  }
  rows.push_back(
      {"page (heap, cells, painted map)", figure("page_mb"), "MB", Bar{Side::at_most, 300.0}});
  rows.push_back({"server", 100.0 * served_s / wall_s, "% of a core", Bar{Side::at_most, 20.0}});
  const LookBackFigures back = look_back_figures(std::chrono::minutes(options.minutes));
  rows.push_back(
      {fmt::format("look back: over {} min of 8 helmets", options.minutes), back.way_s, "s"});
  rows.push_back({"look back: at rest", 100.0 * back.rest_share, "% of a core"});
  rows.push_back(
      {"look back: played", 100.0 * back.play_share, "% of a core", Bar{Side::at_most, 20.0}});
  rows.push_back({"look back: memory", back.memory_mb, "MB"});
  rows.push_back({"helmets shown", figure("helmets"), "", Bar{Side::at_least, kCrowd}});
  return finish({"dashboard", describe_machine(), std::move(rows)}, options.out);
}

}  // namespace

int run_dashboard_bench(std::span<const char* const> arguments) {
  CommandLine line("The page under load, in headless Chromium.", "dashboard");
  DashboardOptions options;
  line.add_out(options.out);
  line.add("--seconds", options.seconds, "how long frames are counted", 1, 3600);
  line.add("--minutes", options.minutes, "how much is recorded to look back at", 2, 600);
  if (const auto status = line.parse(arguments)) return *status;
  return run(options);
}

}  // namespace lifeline::bench
