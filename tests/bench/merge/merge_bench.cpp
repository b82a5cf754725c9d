#include "tests/bench/merge/merge_bench.hpp"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/bench/command_line.hpp"
#include "tests/bench/merge/cross_validation.hpp"
#include "tests/bench/merge/crossed_pairs.hpp"
#include "tests/bench/merge/fleet_pairs.hpp"
#include "tests/bench/merge/handheld_maps.hpp"
#include "tests/bench/merge/merge_pairs.hpp"
#include "tests/bench/merge/negatives.hpp"
#include "tests/bench/merge/path_report.hpp"
#include "tests/bench/report.hpp"

namespace lifeline::bench {
namespace {

struct MergeOptions {
  std::optional<std::filesystem::path> out;
  std::filesystem::path pairs = "../shared/data/mapmerge/pairs";
  std::optional<std::size_t> negatives;
  NegativesChoice choice{.plans = "../shared/data/floorplans/houseexpo"};
};

/// To stderr: the table comes at the end, a minute or more later.
void tell(const std::string& what) {
  fmt::print(stderr, "lifeline-bench: {}\n", what);
}

Judged judge_all(const std::vector<MergePair>& pairs, const matching::MatchConfig& config) {
  Judged judged;
  for (const MergePair& pair : pairs) judged.push_back(judge_pair(pair, config));
  return judged;
}

void write_folds(const std::vector<MergePair>& pairs, Report& report) {
  matching::MatchConfig loose;
  loose.limits = loose.layer_limits = loose_limits();
  std::size_t right = 0, can_merge = 0;
  for (const Fold& fold : cross_validate(judge_all(pairs, loose))) {
    right += fold.right;
    can_merge += fold.can_merge;
    report.rows.push_back(
        {fmt::format("limits learnt without {}: merged wrongly there of {}", fold.building,
                     fold.pairs),
         static_cast<double>(fold.wrong), "", Bar{Bar::Side::at_most, 0.0},
         fmt::format("right {} of {}; margin {}, mirror {}, wall {} m, conflict {}, bend {} sd",
                     fold.right, fold.can_merge, fold.limits.min_margin,
                     fold.limits.min_control_ratio, fold.limits.min_agreeing_wall_m,
                     fold.limits.max_conflict, fold.limits.min_bend_sds)});
  }
  report.rows.push_back({fmt::format("limits learnt elsewhere: merged rightly of {}", can_merge),
                         static_cast<double>(right),
                         "",
                         {},
                         "whose best candidate is right"});
}

void write_crossed(const std::vector<MergePair>& pairs, Report& report) {
  constexpr std::size_t kCount = 1000;
  const CrossedOutcome outcome = match_crossed(pairs, kCount, 1, {});
  report.rows.push_back({fmt::format("maps of two buildings, merged wrongly of {}", outcome.pairs),
                         static_cast<double>(outcome.accepted.size()), "",
                         Bar{Bar::Side::at_most, 0.0}, "drawn from all maps"});
  for (const std::string& wrong : outcome.accepted) fmt::print("wrong: {}\n", wrong);
}

int run_pairs(const MergeOptions& options) {
  const bool recorded = std::filesystem::exists(options.pairs / "index.csv");
  if (!recorded) tell(options.pairs.string() + " is not there: pairs of simulated offices");
  tell("loading the maps");
  Result<std::vector<MergePair>> loaded =
      recorded ? load_pairs(options.pairs) : Result<std::vector<MergePair>>(simulate_pairs(12));
  if (!loaded) {
    tell(loaded.error().text);
    return 1;
  }
  Report report{"merge", describe_machine(), {}};
  matching::MatchConfig oriented, spectra;
  spectra.method = matching::Method::spectra;
  tell(fmt::format("matching {} pairs, oriented", loaded->size()));
  const Judged judged = judge_all(*loaded, oriented);
  tell("the same by spectra");
  write_side_by_side(judged, judge_all(*loaded, spectra), report);
  tell("learning limits on all buildings but one");
  write_folds(*loaded, report);
  if (recorded) {
    tell("maps of different buildings against each other");
    write_crossed(*loaded, report);
  }
  tell("ten helmets on one floor");
  write_fleet_rows(report);
  tell("hand-held maps");
  write_handheld_rows(options.pairs.parent_path(), report);
  return finish(report, options.out);
}

int run_hard_negatives(MergeOptions options) {
  options.choice.pairs = *options.negatives;
  const NegativesOutcome outcome =
      run_negatives(options.choice, {}, [](std::size_t pairs, std::size_t wrong) {
        tell(fmt::format("{} pairs, {} merged wrongly", pairs, wrong));
      });
  Report report{"merge --negatives", describe_machine(), {}};
  for (const NegativeKind& kind : outcome.kinds) {
    report.rows.push_back({fmt::format("{}: merged wrongly of {}", kind.name, kind.pairs),
                           static_cast<double>(kind.accepted_wrong),
                           "",
                           Bar{Bar::Side::at_most, 0.0},
                           {}});
    report.rows.push_back({fmt::format("{}: merged rightly", kind.name),
                           static_cast<double>(kind.accepted_right),
                           "",
                           {},
                           {}});
  }
  for (const FalseAccept& wrong : outcome.wrong) {
    fmt::print("wrong: {}: {} and {}: {}\n", wrong.kind, wrong.a, wrong.b, wrong.reason);
  }
  return finish(report, options.out);
}

}  // namespace

int run_merge_bench(std::span<const char* const> arguments) {
  CommandLine line("How often two maps are merged rightly, wrongly or not at all.", "merge");
  MergeOptions options;
  line.add_out(options.out);
  line.add("--pairs", options.pairs, "folder of pairs with an index.csv");
  line.add("--plans", options.choice.plans, "folder of HouseExpo plans");
  line.add_count("--negatives", options.negatives, "pairs that must not be merged", 10'000);
  line.add("--seed", options.choice.seed, "of the pairs that must not be merged");
  line.add_flag("--pictures", options.choice.pictures,
                "of these, the cells as a saved map has them instead of TSD layers");
  if (const auto status = line.parse(arguments)) return *status;
  return options.negatives ? run_hard_negatives(options) : run_pairs(options);
}

}  // namespace lifeline::bench
