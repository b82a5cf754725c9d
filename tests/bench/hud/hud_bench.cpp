#include "tests/bench/hud/hud_bench.hpp"

#include <cmath>
#include <cstdlib>
#include <thread>

#include <fmt/format.h>
#include <sys/resource.h>

#include "agents/hud/hud.hpp"
#include "common/base/log.hpp"
#include "tests/bench/command_line.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/hud_rooms.hpp"
#include "tests/support/hud_samples.hpp"

namespace lifeline::bench {
namespace {

using std::chrono::milliseconds;

struct HudOptions {
  std::optional<std::filesystem::path> out;
  double seconds = 60.0;
  bool display = false;
};

constexpr double kLong_m = 90.0, kWide_m = 50.0;

/// Offices of 6 x 5 m on corridors of 2 m: 4,500 m2.
Occupancy building(const Eigen::Vector2d& p_m) {
  if (p_m.x() < 0.0 || p_m.x() > kLong_m || p_m.y() < 0.0 || p_m.y() > kWide_m)
    return Occupancy::unknown;
  const double x = std::fmod(p_m.x(), 6.0), y = std::fmod(p_m.y(), 12.0);
  const bool corridor = y > 5.0 && y < 7.0;
  const bool side = !corridor && x < 0.1;
  const bool front =
      (std::abs(y - 5.0) < 0.06 || std::abs(y - 7.0) < 0.06) && std::abs(x - 3.0) > 0.5;
  const bool back = y < 0.1 && std::abs(p_m.x() - 45.0) > 1.0;
  return side || front || back ? Occupancy::occupied : Occupancy::free;
}

double cpu_s() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Up and down the corridors, the head turning all the time.
Pose2 pose_at(double time_s) {
  const double along_m = std::fmod(1.2 * time_s, 170.0);
  const double x_m = along_m < 85.0 ? 2.0 + along_m : 172.0 - along_m;
  return {x_m, 30.0, (along_m < 85.0 ? 0.0 : 3.1) + 0.8 * std::sin(time_s)};
}

struct Cost {
  double frames_s = 0.0;
  double core_percent = 0.0;
};

Result<Cost> measure(hud::Size size, double seconds) {
  hud::HudOptions options;
  options.display = true;
  options.size = size;
  auto hud = hud::Hud::start(options, 0.05, {{2.0, 6.0}, {2.0, 30.0}});
  if (!hud) return forward_error(hud);
  const auto tiles = test::drawn_tiles({0.0, 0.0}, {kLong_m, kWide_m}, building);
  (*hud)->put(tiles);
  std::this_thread::sleep_for(std::chrono::seconds(2));  // everything is there for the first time
  const auto began = std::chrono::steady_clock::now();
  const double cpu_before_s = cpu_s();
  const std::uint64_t frames_before = (*hud)->pictures_shown();
  auto now = began;
  for (std::size_t tick = 0; to_seconds(now - began) < seconds; ++tick) {
    auto facts = test::sound_facts(now);
    facts.shares = true;
    facts.state.T_map_head = pose_at(to_seconds(now - began));
    for (int i = 0; i < 8; ++i)
      facts.mates.push_back({fmt::format("ff{}", i), Pose2{10.0 * i, 30.0, 0.1 * i}, 90, now});
    facts.finds = {{{20.0, 33.0}, wire::DetectionKind::victim, true},
                   {{50.0, 20.0}, wire::DetectionKind::victim, false}};
    facts.search = hud::SearchFacts{{60.0, 33.0}, 40.0};
    (*hud)->put(std::move(facts));
    // A walk changes a few tiles each time.
    sharing::MapTiles changed;
    for (std::size_t i = 0; i < 6; ++i) changed.push_back(tiles[(7 * tick + i) % tiles.size()]);
    (*hud)->put(changed);
    std::this_thread::sleep_for(milliseconds(100));
    now = std::chrono::steady_clock::now();
  }
  const double took_s = to_seconds(now - began);
  return Cost{static_cast<double>((*hud)->pictures_shown() - frames_before) / took_s,
              100.0 * (cpu_s() - cpu_before_s) / took_s};
}

int run(const HudOptions& options) {
  spdlog::set_level(spdlog::level::warn);
  if (!options.display) ::setenv("SDL_VIDEODRIVER", "dummy", 1);
  Report report{"hud", describe_machine(), {}};
  for (const hud::Size size : {hud::Size{800, 480}, hud::Size{1280, 720}}) {
    const auto cost = measure(size, options.seconds);
    if (!cost) {
      fmt::print(stderr, "lifeline bench: {}\n", cost.error().text);
      return 1;
    }
    const std::string name = fmt::format("{} x {}, ", size.width, size.height);
    report.rows.push_back(
        {name + "pictures", cost->frames_s, "1/s", Bar{Bar::Side::at_least, 29.0}});
    report.rows.push_back(
        {name + "of a core", cost->core_percent, "%", Bar{Bar::Side::at_most, 15.0}});
  }
  return finish(report, options.out);
}

}  // namespace

int run_hud_bench(std::span<const char* const> arguments) {
  HudOptions options;
  CommandLine line("What the helmet's HUD costs", "hud");
  line.add_out(options.out);
  line.add("--seconds", options.seconds, "How long each size is shown", 1.0, 3600.0);
  line.add_flag("--display", options.display, "On this machine's display, not on none");
  if (const auto status = line.parse(arguments)) return *status;
  return run(options);
}

}  // namespace lifeline::bench
