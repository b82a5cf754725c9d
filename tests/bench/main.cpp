// lifeline-bench NAME [OPTIONS]: runs one benchmark and judges its figures.

#include <cstdio>
#include <exception>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "tests/bench/codec/codec_bench.hpp"
#include "tests/bench/dashboard/dashboard_bench.hpp"
#include "tests/bench/fleet/fleet_bench.hpp"
#include "tests/bench/hud/hud_bench.hpp"
#include "tests/bench/merge/merge_bench.hpp"
#include "tests/bench/mission/mission_bench.hpp"
#include "tests/bench/paper/paper_bench.hpp"
#include "tests/bench/radio/radio_bench.hpp"
#include "tests/bench/search/search_bench.hpp"
#include "tests/bench/slam/slam_bench.hpp"

namespace {

/// Takes what follows the benchmark's name; answers the exit status: 0 all bars hold, 1 one does
/// not or something failed, 2 wrong use.
using Bench = int (*)(std::span<const char* const> arguments);

const std::map<std::string_view, Bench> kBenches{
    {"codec", lifeline::bench::run_codec_bench},
    {"dashboard", lifeline::bench::run_dashboard_bench},
    {"fleet", lifeline::bench::run_fleet_bench},
    {"hud", lifeline::bench::run_hud_bench},
    {"merge", lifeline::bench::run_merge_bench},
    {"mission", lifeline::bench::run_mission_bench},
    {"paper", lifeline::bench::run_paper_bench},
    {"radio", lifeline::bench::run_radio_bench},
    {"search", lifeline::bench::run_search_bench},
    {"slam", lifeline::bench::run_slam_bench},
};

}  // namespace

int main(int argc, char** argv) {
  const std::span<const char* const> arguments(argv, static_cast<std::size_t>(argc));
  const auto bench = argc > 1 ? kBenches.find(arguments[1]) : kBenches.end();
  if (bench == kBenches.end()) {
    std::string names;
    for (const auto& [name, run] : kBenches) names += " " + std::string(name);
    fmt::print(stderr, "lifeline bench: give the name of one of these:{}\n", names);
    return 2;
  }
  try {
    return bench->second(arguments.subspan(2));
  } catch (const std::exception& problem) {
    fmt::print(stderr, "lifeline bench: {}\n", problem.what());
    return 1;
  }
}
