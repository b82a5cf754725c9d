#include "tests/bench/paper/paper_bench.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "tests/bench/command_line.hpp"
#include "tests/bench/paper/doors_study.hpp"
#include "tests/bench/paper/timing_study.hpp"
#include "tests/bench/paper/update_study.hpp"

namespace lifeline::bench {
namespace {

struct Options {
  std::optional<std::filesystem::path> out;
  std::optional<std::filesystem::path> pictures;
  std::uint64_t seeds = 20;
  double duration_s = 90.0;
  std::string only = "abc";
  int experiment = 0;  ///< 0: all
};

Report run(const Options& options) {
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
  CLI::App app("The paper's four experiments in simulated buildings.", "lifeline bench paper");
  Options options;
  app.add_option("--out", options.out, "the figures as JSON");
  app.add_option("--pictures", options.pictures, "folder for pictures of the first seed");
  app.add_option("--seeds", options.seeds, "buildings of each kind, from seed 1")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  app.add_option("--duration", options.duration_s, "of each walk, seconds")
      ->check(CLI::Range(10.0, 3600.0))
      ->capture_default_str();
  app.add_option("--only", options.only, "which of a (doors), b (timing), c (update)")
      ->capture_default_str();
  app.add_option("--experiment", options.experiment, "one of 1 to 4; all without it")
      ->check(CLI::Range(1, 4));
  if (const auto status = parse_arguments(app, arguments)) return *status;
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
