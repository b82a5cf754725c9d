#include "tests/bench/paper/paper_bench.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "tests/bench/command_line.hpp"
#include "tests/bench/paper/doors_study.hpp"
#include "tests/bench/paper/timing_study.hpp"
#include "tests/bench/paper/update_study.hpp"

namespace lifeline::bench {
namespace {

struct PaperOptions {
  std::optional<std::filesystem::path> out;
  std::optional<std::filesystem::path> pictures;
  std::uint64_t seeds = 20;
  double duration_s = 90.0;
  std::string only = "abc";
  int experiment = 0;  ///< 0: all
};

Report run(const PaperOptions& options) {
  DoorsStudy doors;
  TimingStudy timing(options.duration_s);
  UpdateStudy update;
  const auto wanted = [&](char study) { return options.only.find(study) != std::string::npos; };
  for (const PaperExperiment& experiment : kPaperExperiments) {
    if (options.experiment != 0 && options.experiment != experiment.number) continue;
    for (std::uint64_t seed = 1; seed <= options.seeds; ++seed) {
      fmt::print(stderr, "lifeline-bench: experiment {}, seed {}\n", experiment.number, seed);
      const PaperWalk walk = walk_through(experiment, seed, options.duration_s);
      const auto picture = [&](char study) -> std::optional<std::filesystem::path> {
        if (!options.pictures || seed != 1) return std::nullopt;
        return *options.pictures / fmt::format("{}{}.png", study, experiment.number);
      };
      if (wanted('a')) doors.play(experiment, walk, picture('a'));
      if (wanted('b')) timing.play(experiment, walk, picture('b'));
      if (wanted('c')) update.play(experiment, walk, seed, picture('c'));
    }
  }
  Report report{"paper", describe_machine(), {}};
  for (auto rows : {doors.rows(), timing.rows(), update.rows()}) {
    for (ReportRow& row : rows) report.rows.push_back(std::move(row));
  }
  return report;
}

}  // namespace

int run_paper_bench(std::span<const char* const> arguments) {
  CommandLine line("The paper's four experiments in simulated buildings.", "paper");
  PaperOptions options;
  line.add_out(options.out);
  line.add("--pictures", options.pictures, "folder for pictures of the first seed");
  line.add("--seeds", options.seeds, "buildings of each kind, from seed 1", std::uint64_t{1},
           std::uint64_t{10'000});
  line.add("--duration", options.duration_s, "of each walk, seconds", 10.0, 3600.0);
  line.add("--only", options.only, "which of a (doors), b (timing), c (update)");
  line.add("--experiment", options.experiment, "one of 1 to 4; all without it", 1, 4);
  if (const auto status = line.parse(arguments)) return *status;
  if (options.only.empty() || options.only.find_first_not_of("abc") != std::string::npos) {
    fmt::print(stderr, "lifeline bench paper: --only {}: give one or more of a, b and c\n",
               options.only);
    return 2;
  }
  // A matcher that gets lost says so at every walk.
  spdlog::set_level(spdlog::level::err);
  if (options.pictures) std::filesystem::create_directories(*options.pictures);
  const Report report = run(options);
  return finish(report, options.out);
}

}  // namespace lifeline::bench
