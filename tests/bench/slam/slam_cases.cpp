#include "tests/bench/slam/slam_cases.hpp"

#include <fstream>
#include <utility>

#include <fmt/format.h>

namespace lifeline::bench {
namespace {

using std::filesystem::path;

struct CarmenLog {
  const char* name;
  int beams;
  std::optional<double> odometry_bar;
  std::optional<double> ahrs_bar;
  const char* odometry_reference;
  const char* ahrs_reference;
};

constexpr CarmenLog kCarmenLogs[] = {
    {"aces", 180, 0.12, 0.30, "0.10-0.12 by no single system", "lost (> 10), prototype 0.50"},
    {"csail", 361, 0.12, 0.50, "0.10-0.12 by no single system", "lost (> 10), prototype 1.33"},
    {"seattle", 361, {}, {}, "", ""},
    {"edmonton", 180, {}, {}, "", ""},
    {"acapulco", 181, {}, {}, "", ""},
};

std::string carmen(const path& data, const std::string& name, const std::string& prior) {
  return fmt::format("carmen:{}?prior={}", (data / "carmen" / (name + "-rawodom.log.gz")).string(),
                     prior);
}

const char* prior_name(const std::string& prior) {
  return prior == "none" ? "no prior" : "yaw";
}

void add_intel(const path& data, std::vector<LogCase>& cases) {
  LogCase intel{.name = "intel, odometry",
                .source = carmen(data, "intel", "odom"),
                .measure = Measure::relations,
                .bar = 0.055,
                .reference = "AutonOHM TSD 0.0597, GMapping 0.0591, Karto 0.101, Hector lost",
                .truth = data / "relations/intel.relations",
                .odometry = data / "carmen/intel-rawodom.log.gz",
                .beams = 180};
  cases.push_back(intel);
  intel.name = "intel, ahrs";
  intel.source = carmen(data, "intel", "ahrs");
  intel.bar = 0.10;
  intel.worst = 0.5;
  intel.reference = "all lost (Karto 0.75), prototype 0.17";
  cases.push_back(intel);
  // Without bars: nobody survives these on keyframes half a metre apart.
  intel.bar = intel.worst = std::nullopt;
  intel.reference = "all lost";
  for (const char* prior : {"yaw", "none"}) {
    intel.name = fmt::format("intel, {}", prior_name(prior));
    intel.source = carmen(data, "intel", prior);
    cases.push_back(intel);
  }
}

void add_carmen(const path& data, const CarmenLog& log, std::vector<LogCase>& cases) {
  LogCase add{.name = fmt::format("{}, odometry", log.name),
              .source = carmen(data, log.name, "odom"),
              .bar = log.odometry_bar,
              .reference = log.odometry_reference,
              .beams = log.beams};
  cases.push_back(add);
  add.name = fmt::format("{}, ahrs", log.name);
  add.source = carmen(data, log.name, "ahrs");
  add.bar = log.ahrs_bar;
  add.reference = log.ahrs_reference;
  cases.push_back(add);
  add.bar = std::nullopt;
  add.reference = "";
  for (const char* prior : {"yaw", "none"}) {
    add.name = fmt::format("{}, {}", log.name, prior_name(prior));
    add.source = carmen(data, log.name, prior);
    cases.push_back(add);
  }
}

/// The file or folder that a source plays.
path target(const std::string& source) {
  const auto begin = source.find(':') + 1;
  return source.substr(begin, source.rfind('?') - begin);
}

}  // namespace

std::vector<LogCase> log_cases(const path& data) {
  std::vector<LogCase> cases;
  add_intel(data, cases);
  for (const CarmenLog& log : kCarmenLogs) add_carmen(data, log, cases);
  const auto bag = [&](const char* name) { return "rosbag2:" + (data / "bags" / name).string(); };
  cases.push_back({.name = "jackal_mocap_a, no prior",
                   .source = bag("jackal_mocap_a"),
                   .measure = Measure::body_rmse,
                   .bar = 0.025,
                   .reference = "best peer 0.034",
                   .truth = data / "bags/jackal_mocap_a/mocap.tum"});
  cases.push_back({.name = "mines-exp1, no prior",
                   .source = "columns:" + (data / "scans10hz/mines-exp1.dat.gz").string(),
                   .measure = Measure::failures,
                   .bar = 0.0});
  for (const char* name : {"jackal_mocap_static", "static_varbeams", "urg_room_ros1"}) {
    cases.push_back({.name = fmt::format("{}, no prior", name),
                     .source = bag(name),
                     .measure = Measure::failures});
  }
  std::erase_if(cases, [](const LogCase& log) {
    return !std::filesystem::exists(target(log.source)) ||
           (!log.truth.empty() && !std::filesystem::exists(log.truth));
  });
  return cases;
}

std::vector<path> spread_plans(const path& data, std::size_t count) {
  const path folder = data / "floorplans/houseexpo";
  std::ifstream index(folder / "index.csv");
  std::vector<path> plans;
  std::string line;
  std::getline(index, line);  // the columns' names
  while (std::getline(index, line)) {
    path plan = folder / (line.substr(0, line.find(',')) + ".json");
    if (std::filesystem::exists(plan)) plans.push_back(std::move(plan));
  }
  if (plans.size() <= count) return plans;
  std::vector<path> spread;
  for (std::size_t i = 0; i < count; ++i) {
    spread.push_back(plans[i * (plans.size() - 1) / (count > 1 ? count - 1 : 1)]);
  }
  return spread;
}

}  // namespace lifeline::bench
