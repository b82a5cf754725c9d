#include "tests/bench/radio/radio_fleet.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <signal.h>

namespace lifeline::bench {
namespace {

constexpr std::array kNames{
    "alpha",  "bravo", "charlie", "delta", "echo",    "foxtrot", "golf",    "hotel",
    "india",  "julia", "kilo",    "lima",  "mike",    "nova",    "oscar",   "papa",
    "quebec", "romeo", "sierra",  "tango", "uniform", "victor",  "whiskey", "xray",
    "yankee", "zulu",  "amber",   "blue",  "coral",   "denim",   "ebony",   "fawn"};
constexpr const char* kCoordinator = "coordinator";
constexpr const char* kWatch = "watch";
constexpr const char* kStandby = "standby";

}  // namespace

double wall_now_s() {
  return to_seconds(std::chrono::system_clock::now().time_since_epoch());
}

Result<RadioFleet> RadioFleet::start(RadioNet* net, const Options& options) {
  RadioFleet fleet(net, options);
  std::filesystem::create_directories(options.folder);
  std::ofstream(options.folder / "agent.yaml")
      << "sharing:\n  interface: " << (net == nullptr ? "none" : "w0")
      << "\n  coarse_tiles: " << (options.coarse_tiles ? "true\n" : "false\n");
  auto watch = fleet.begin(fleet.last_host(), kWatch, {"watch", "--json"}, "lifeline-coordinator");
  if (!watch) return forward_error(watch);
  fleet.running_.emplace(kWatch, *std::move(watch));
  if (auto started = fleet.start_coordinator(); !started) return forward_error(started);
  for (int helmet = 0; helmet < options.helmets; ++helmet) {
    if (auto started = fleet.start_helmet(helmet, fleet.source_of(helmet)); !started)
      return forward_error(started);
  }
  return fleet;
}

Result<demo::ChildProcess> RadioFleet::begin(int host, const std::string& name,
                                             std::vector<std::string> arguments,
                                             const std::string& program) {
  arguments.insert(arguments.begin(), (options_.programs / program).string());
  for (const std::string& word : {std::string("--mission"), std::string("radio"),
                                  std::string("--qos"), options_.qos.string()}) {
    arguments.push_back(word);
  }
  arguments.insert(arguments.end(), {"--domain", std::to_string(options_.domain)});
  if (net_ != nullptr) arguments = net_->on(host, std::move(arguments));
  return demo::ChildProcess::start({std::move(arguments), options_.folder / (name + ".log")});
}

std::string RadioFleet::name_of(int helmet) {
  return kNames.at(static_cast<std::size_t>(helmet));
}

void RadioFleet::end_helmets() {
  for (int helmet = 0; helmet < options_.helmets; ++helmet) {
    const auto process = running_.find(name_of(helmet));
    if (process == running_.end()) continue;
    process->second.send(SIGTERM);
    while (!process->second.ended()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    running_.erase(process);
  }
}

std::filesystem::path RadioFleet::journal_of(int helmet) const {
  return options_.folder / (name_of(helmet) + ".journal");
}

std::string RadioFleet::source_of(int helmet) const {
  // No more than 16 walk apart from one another: the others follow them.
  constexpr int kMostWalkers = 16;
  return fmt::format("sim:office?seed=3&walkers={}&walker={}&duration={}&{}",
                     std::min(options_.helmets, kMostWalkers), helmet % kMostWalkers,
                     options_.walk_s, options_.source_options);
}

Result<void> RadioFleet::start_coordinator() {
  auto process = begin(1, kCoordinator, {"run"}, "lifeline-coordinator");
  if (!process) return forward_error(process);
  running_.erase(kCoordinator);
  running_.emplace(kCoordinator, *std::move(process));
  return {};
}

Result<void> RadioFleet::start_helmet(int helmet, const std::string& source) {
  const std::string name = name_of(helmet);
  std::vector<std::string> arguments{"run",
                                     "--id",
                                     name,
                                     "--source",
                                     source,
                                     "--config",
                                     (options_.folder / "agent.yaml").string()};
  if (options_.budget_bit_s > 0)
    arguments.insert(arguments.end(), {"--budget", std::to_string(options_.budget_bit_s)});
  if (options_.journals)
    arguments.insert(arguments.end(), {"--journal", journal_of(helmet).string()});
  auto process = begin(host_of(helmet), name, std::move(arguments), "lifeline-agent");
  if (!process) return forward_error(process);
  running_.erase(name);
  running_.emplace(name, *std::move(process));
  return {};
}

Result<void> RadioFleet::start_standby() {
  auto process =
      begin(last_host() - 1, kStandby, {"run", "--id", kStandby, "--standby", "--dashboard", "off"},
            "lifeline-coordinator");
  if (!process) return forward_error(process);
  running_.emplace(kStandby, *std::move(process));
  return {};
}

std::map<std::string, double> RadioFleet::memory_mb() {
  std::map<std::string, double> memory;
  for (const auto& [name, process] : running_) {
    if (!is_machine(name)) continue;
    std::ifstream file(fmt::format("/proc/{}/smaps_rollup", process.pid()));
    for (std::string word; file >> word;) {
      if (word != "Pss:") continue;
      double kilobytes = 0.0;
      file >> kilobytes;
      memory[name] = kilobytes / 1024.0;
      break;
    }
  }
  return memory;
}

bool RadioFleet::is_machine(const std::string& name) const {
  return name != kWatch;
}

bool RadioFleet::standby_holds_all() const {
  const auto standby = heard_.find(kStandby), coordinator = heard_.find(kCoordinator);
  return standby != heard_.end() && coordinator != heard_.end() &&
         standby->second.tiles == coordinator->second.tiles &&
         standby->second.common_map_sha256 == coordinator->second.common_map_sha256;
}

bool RadioFleet::all_have_met() const {
  return std::ranges::all_of(running_, [&](const auto& running) {
    if (!is_machine(running.first)) return true;
    const auto met = met_.find(running.first);
    return met != met_.end() && std::ranges::all_of(running_, [&](const auto& other) {
             return !is_machine(other.first) || other.first == running.first ||
                    met->second.contains(other.first);
           });
  });
}

bool RadioFleet::all_hear_all() const {
  return std::ranges::all_of(running_, [&](const auto& running) {
    if (!is_machine(running.first)) return true;
    const auto status = heard_.find(running.first);
    return status != heard_.end() && status->second.peers_heard.size() + 2 >= running_.size();
  });
}

void RadioFleet::kill_helmet(int helmet) {
  const std::string name = name_of(helmet);
  running_.at(name).send(SIGKILL);
  running_.erase(name);
}

void RadioFleet::kill_coordinator() {
  running_.at(kCoordinator).send(SIGKILL);
  running_.erase(kCoordinator);
}

void RadioFleet::listen(Duration time) {
  std::this_thread::sleep_for(time);
  if (!watch_.is_open()) watch_.open(options_.folder / (std::string(kWatch) + ".log"));
  watch_.clear();
  for (std::string part; std::getline(watch_, part);) {
    begun_line_ += part;
    if (watch_.eof()) break;  // the rest of the line is still to come
    take_line(std::exchange(begun_line_, {}));
  }
}

void RadioFleet::take_line(const std::string& line) {
  const auto told = nlohmann::json::parse(line, nullptr, false);
  if (!told.is_object()) return;
  if (told.contains("pose")) {
    poses_[told["pose"]].push_back({told["sent_at_s"], told["heard_at_s"]});
  } else if (told.contains("status")) {
    heard_[told["status"]] = {told["heard_at_s"],    told["role"] == "helmet",  told["finished"],
                              told["explored_m2"],   told["common_map_sha256"], told["scans"],
                              told["scans_dropped"], told["samples_refused"],   told["tiles"],
                              told["peers_heard"]};
    const auto& peers = heard_[told["status"]].peers_heard;
    met_[told["status"]].insert(peers.begin(), peers.end());
  }
}

bool RadioFleet::somebody_ended() {
  for (auto& [name, process] : running_) {
    if (const auto status = process.ended()) {
      fmt::print(stderr, "radio: {} ended with status {}; see {}\n", name, *status,
                 (options_.folder / (name + ".log")).string());
      return true;
    }
  }
  return false;
}

bool RadioFleet::all_equal(double since_s) const {
  std::set<std::string> maps;
  for (const auto& [name, process] : running_) {
    if (!is_machine(name)) continue;
    const auto status = heard_.find(name);
    if (status == heard_.end() || status->second.heard_at_s < since_s) return false;
    maps.insert(status->second.common_map_sha256);
  }
  return maps.size() == 1 && maps.begin()->find_first_not_of('0') != std::string::npos;
}

bool RadioFleet::all_helmets(const std::function<bool(const HeardStatus&)>& holds) const {
  return std::ranges::all_of(running_, [&](const auto& running) {
    if (!is_machine(running.first) || running.first == kCoordinator || running.first == kStandby) {
      return true;
    }
    const auto status = heard_.find(running.first);
    return status != heard_.end() && holds(status->second);
  });
}

bool RadioFleet::all_finished() const {
  return all_helmets([](const HeardStatus& status) { return status.finished; });
}

bool RadioFleet::all_walk() const {
  return all_helmets([](const HeardStatus& status) { return status.scans > 0; });
}

}  // namespace lifeline::bench
