#include "tests/bench/radio/radio_bench.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/base/quantile.hpp"
#include "tests/bench/command_line.hpp"
#include "tests/bench/radio/fleet_bench.hpp"
#include "tests/bench/radio/radio_traffic.hpp"

namespace lifeline::bench {
namespace {

using std::chrono::seconds;

struct RadioOptions {
  std::optional<std::filesystem::path> out;
  std::optional<std::filesystem::path> qos;
  std::string only;
  int helmets = 8;
  double walk_s = 60.0;
  bool fine = false;
  bool kinds = false;
};

/// What all cases share.
struct RadioBench : FleetBench {
  RadioOptions options;
  double lossless_octets = kMissed;  ///< of all helmets, from start to equal maps
};

/// A fresh net and fleet for one case; hosts are the coordinator's, the helmets' and the watch's.
struct RadioCase {
  std::unique_ptr<RadioNet> net;  ///< stays where it is: the fleet starts programs on it later, too
  std::unique_ptr<RadioTraffic> traffic;  ///< of the helmets, where it is asked for
  std::unique_ptr<RadioFleet> fleet;
};

std::set<int> helmet_hosts(const RadioBench& bench) {
  std::set<int> hosts;
  for (int helmet = 0; helmet < bench.options.helmets; ++helmet)
    hosts.insert(RadioFleet::host_of(helmet));
  return hosts;
}

/// `heard`: whose traffic is told apart, where that is asked for.
Result<RadioCase> begin(const RadioBench& bench, const std::string& name, double loss,
                        const std::set<int>& heard) {
  auto net = RadioNet::make(bench.options.helmets + 3);
  if (!net) return forward_error(net);
  RadioCase begun{std::make_unique<RadioNet>(*std::move(net)), nullptr, nullptr};
  if (auto set = begun.net->set_loss(loss); !set) return forward_error(set);
  if (bench.options.kinds) {
    auto traffic = RadioTraffic::listen(*begun.net, heard);
    if (!traffic) return forward_error(traffic);
    begun.traffic = *std::move(traffic);
  }
  RadioFleet::Options options = bench.fleet;
  options.folder /= name;
  auto fleet = RadioFleet::start(*begun.net, options);
  if (!fleet) return forward_error(fleet);
  begun.fleet = std::make_unique<RadioFleet>(*std::move(fleet));
  return begun;
}

Result<RadioCase> begin(const RadioBench& bench, const std::string& name, double loss) {
  return begin(bench, name, loss, helmet_hosts(bench));
}

double octets(const RadioBench& bench, const RadioNet& net) {
  double sum = 0.0;
  for (const int host : helmet_hosts(bench)) sum += static_cast<double>(net.octets_sent(host));
  return sum;
}

void tell_kinds(RadioBench& bench, const std::string& name, RadioCase& of) {
  if (of.traffic == nullptr) return;
  for (const auto& [kind, octets] : of.traffic->stop())
    bench.row(fmt::format("{}: {}", name, kind), 1e-3 * static_cast<double>(octets), "kB", {});
}

double or_missed(std::optional<double> value) {
  return value.value_or(kMissed);
}

double worst_pose_age_s(RadioFleet& fleet) {
  double worst = 0.0;
  for (const auto& [helmet, poses] : fleet.take_poses())
    worst = std::max(worst, quantile(ages_on_arrival_s(poses), 0.95));
  return worst;
}

Result<void> walk_with_loss(RadioBench& bench, double loss, double equal_within_s, double times) {
  const std::string name = fmt::format("loss {:.0f} %", 100.0 * loss);
  auto begun = begin(bench, name, loss);
  if (!begun) return forward_error(begun);
  RadioFleet& fleet = *begun->fleet;
  const auto walked = fleet.until([](const auto& f) { return f.all_finished(); },
                                  from_seconds(bench.options.walk_s) + seconds(60));
  const double walked_octets = octets(bench, *begun->net);
  const auto equal = fleet.until([](const auto& f) { return f.all_equal(); }, seconds(150));
  bench.row(name + ": from the end of the walk to equal maps", or_missed(walked ? equal : walked),
            "s", equal_within_s);
  const double sent = octets(bench, *begun->net);
  tell_kinds(bench, name, *begun);
  if (loss == 0.0) {
    bench.lossless_octets = sent;
    const double helmets = bench.options.helmets;
    bench.row("a helmet's rate while walking, everything included, for each receiver",
              1e-3 * walked_octets / helmets / or_missed(walked) / (helmets + 1), "kB/s", 4.0);
  } else {
    bench.row(name + ": octets sent, times those without loss", sent / bench.lossless_octets, "",
              times);
  }
  bench.row(name + ": age of a pose on arrival, p95 of the worst helmet", worst_pose_age_s(fleet),
            "s", 1.0);
  return {};
}

Result<void> walk_apart(RadioBench& bench) {
  auto begun = begin(bench, "parted", 0.0);
  if (!begun) return forward_error(begun);
  std::set<int> far;
  for (int helmet = bench.options.helmets / 2; helmet < bench.options.helmets; ++helmet)
    far.insert(RadioFleet::host_of(helmet));
  // Healed as the walks end: until then the maps change from scan to scan.
  (void)begun->fleet->until([](const auto& f) { return f.all_walk(); }, seconds(30));
  begun->fleet->listen(from_seconds(bench.options.walk_s - 20.0));
  if (auto parted = begun->net->part(far); !parted) return parted;
  begun->fleet->listen(seconds(20));
  if (auto healed = begun->net->heal(); !healed) return healed;
  const double healed_at_s = wall_now_s();
  const auto equal = begun->fleet->until(
      [&](const auto& f) { return f.all_finished() && f.all_equal(healed_at_s); }, seconds(90));
  bench.row("half of the helmets parted for 20 s while all map: equal after healing",
            or_missed(equal), "s", 5.0);
  return {};
}

Result<void> off_the_air(RadioBench& bench) {
  auto begun = begin(bench, "off the air", 0.0);
  if (!begun) return forward_error(begun);
  const int host = RadioFleet::host_of(0);
  begun->fleet->listen(from_seconds(std::max(1.0, bench.options.walk_s - 50.0)));
  if (auto cut = begun->net->part({host}); !cut) return cut;
  begun->fleet->listen(seconds(60));
  if (auto healed = begun->net->heal(); !healed) return healed;
  const double healed_at_s = wall_now_s();
  const auto equal = begun->fleet->until(
      [&](const auto& f) { return f.all_finished() && f.all_equal(healed_at_s); }, seconds(90));
  bench.row("one helmet off the air for 60 s: equal afterwards", or_missed(equal), "s", 5.0);
  const auto status = begun->fleet->heard().find("alpha");
  bench.row("the same: scans that it dropped",
            status == begun->fleet->heard().end()
                ? kMissed
                : static_cast<double>(status->second.scans_dropped),
            "", 0.0);
  return {};
}

Result<void> narrow_link(RadioBench& bench) {
  auto begun = begin(bench, "narrow link", 0.0, {RadioFleet::host_of(0)});
  if (!begun) return forward_error(begun);
  if (auto set = begun->net->set_rate(RadioFleet::host_of(0), 250); !set) return set;
  const double begun_at_s = wall_now_s();
  begun->fleet->listen(from_seconds(bench.options.walk_s));
  const auto poses = begun->fleet->take_poses()["alpha"];
  bench.row("250 kbit/s for a helmet: until its first pose arrives",
            poses.empty() ? kMissed : poses.front().heard_at_s - begun_at_s, "s", {});
  bench.row("250 kbit/s for a helmet: age of its pose on arrival, p95",
            poses.empty() ? kMissed : quantile(ages_on_arrival_s(poses), 0.95), "s", {});
  bench.row("250 kbit/s for a helmet: age of its newest pose at the others, p95",
            poses.empty() ? kMissed : quantile(ages_shown_s(poses, wall_now_s()), 0.95), "s", 1.0);
  tell_kinds(bench, "250 kbit/s for a helmet", *begun);
  return {};
}

/// Helmets map a large building as fast as they can; then one more machine comes, over links of 5
/// Mbit/s, and needs every tile.
Result<void> large_map(RadioBench& bench, double loss, double within_s) {
  const std::string name = fmt::format("late joiner, large map, loss {:.0f} %", 100.0 * loss);
  RadioBench large{{bench.fleet, {}}, bench.options};
  large.fleet.walk_s = 300.0;
  large.fleet.source_options = "beams=400&rate=max&width=80&depth=60";
  auto begun = begin(large, name, 0.0);
  if (!begun) return forward_error(begun);
  RadioFleet& fleet = *begun->fleet;
  const auto settled =
      fleet.until([](const auto& f) { return f.all_finished() && f.all_equal(); }, seconds(420));
  const auto tiles = fleet.heard().find("coordinator");
  bench.row(name + ": tiles",
            tiles == fleet.heard().end() ? kMissed : static_cast<double>(tiles->second.tiles), "",
            {});
  for (int host = 1; host < begun->net->hosts(); ++host) {
    if (auto set = begun->net->set_rate(host, 5000); !set) return set;
  }
  if (auto set = begun->net->set_loss(loss); !set) return set;
  if (auto started = fleet.start_standby(); !started) return started;
  const auto whole = fleet.until([](const auto& f) { return f.standby_holds_all(); }, seconds(120));
  bench.row(name + ": from its start until it shows the whole map",
            settled ? or_missed(whole) : kMissed, "s", within_s);
  return {};
}

Result<void> late_joiner(RadioBench& bench) {
  auto begun = begin(bench, "late joiner", 0.0);
  if (!begun) return forward_error(begun);
  RadioFleet& fleet = *begun->fleet;
  const auto settled = fleet.until([](const auto& f) { return f.all_finished() && f.all_equal(); },
                                   from_seconds(bench.options.walk_s) + seconds(90));
  if (!settled) {
    bench.row("late joiner: the others never held one map", kMissed, "s", 5.0);
    return {};
  }
  // A coordinator that starts with nothing is the one machine that needs every tile.
  fleet.kill_coordinator();
  if (auto started = fleet.start_coordinator(); !started) return started;
  const double since_s = wall_now_s();
  const auto equal = fleet.until([&](const auto& f) { return f.all_equal(since_s); }, seconds(90));
  bench.row("a coordinator killed and started with nothing: all equal again", or_missed(equal), "s",
            10.0);
  return {};
}

int run(const RadioOptions& options) {
  auto prepared = prepare_fleet_bench("radio", "wifi.xml");
  if (!prepared) {
    fmt::print(stderr, "lifeline bench: {}\n", prepared.error().text);
    return 1;
  }
  RadioBench bench{*std::move(prepared), options};
  if (options.qos) bench.fleet.qos = *options.qos;
  bench.fleet.helmets = options.helmets;
  bench.fleet.walk_s = options.walk_s;
  bench.fleet.coarse_tiles = !options.fine;
  return run_cases(bench,
                   {{"loss 0", [&] { return walk_with_loss(bench, 0.0, 5.0, 1.0); }},
                    {"loss 10", [&] { return walk_with_loss(bench, 0.1, 5.0, 1.6); }},
                    {"loss 30", [&] { return walk_with_loss(bench, 0.3, 10.0, 2.2); }},
                    {"loss 50", [&] { return walk_with_loss(bench, 0.5, 120.0, 3.5); }},
                    {"parted", [&] { return walk_apart(bench); }},
                    {"off the air", [&] { return off_the_air(bench); }},
                    {"narrow link", [&] { return narrow_link(bench); }},
                    {"late joiner", [&] { return late_joiner(bench); }},
                    {"large map", [&] { return large_map(bench, 0.0, 5.0); }},
                    {"large map with loss", [&] { return large_map(bench, 0.3, 15.0); }}},
                   options.only, options.out);
}

}  // namespace

int run_radio_bench(std::span<const char* const> arguments) {
  CommandLine line("Sharing over a radio that loses and parts, with the real programs.", "radio");
  RadioOptions options;
  line.add_out(options.out);
  line.add("--only", options.only, "cases whose name holds this");
  line.add("--helmets", options.helmets, "how many", 2, 16);
  line.add("--walk", options.walk_s, "seconds that each walks", 10.0, 600.0);
  line.add_flag("--fine", options.fine, "without sharing.coarse_tiles");
  line.add_flag("--kinds", options.kinds, "what the octets are made of, too");
  line.add("--qos", options.qos, "instead of config/qos/wifi.xml");
  if (const auto status = line.parse(arguments)) return *status;
  return run(options);
}

}  // namespace lifeline::bench
