#include "tests/bench/merge/merge_bench.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tests/bench/merge/merge_pairs.hpp"
#include "tests/bench/merge/negatives.hpp"
#include "tests/bench/report.hpp"

namespace lifeline::bench {
namespace {

using Judged = std::vector<JudgedPair>;

struct OverlapBin {
  double from, to;
  double least_right;  ///< per cent that the default path must merge rightly
};
constexpr OverlapBin kSame[] = {
    {0.0, 0.2, 40.0}, {0.2, 0.3, 80.0}, {0.3, 0.4, 95.0}, {0.4, 1.01, 98.0}};
constexpr OverlapBin kDrift[] = {{0.3, 1.01, 60.0}};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  return values[std::min(values.size() - 1, at)];
}

std::vector<double> collect(const Judged& judged, const std::function<bool(const JudgedPair&)>& of,
                            const std::function<double(const JudgedPair&)>& value) {
  std::vector<double> values;
  for (const JudgedPair& pair : judged) {
    if (of(pair)) values.push_back(value(pair));
  }
  return values;
}

/// Writes the figures of one path; only those of the default have bars.
class PathReport {
 public:
  PathReport(const char* path, bool has_bars, const Judged& judged, Report& report)
      : path_(path), has_bars_(has_bars), judged_(judged), report_(report) {}

  void write() {
    for (const OverlapBin& bin : kSame) write_bin("same", bin);
    for (const OverlapBin& bin : kDrift) write_bin("drift10_", bin);
    for (const char* kind : {"same", "drift10_", "different", "disjoint"}) write_wrong(kind);
    const auto good = [](const JudgedPair& p) {
      return p.pair->kind == "same" && p.result.accepted() && p.right();
    };
    const auto metres = collect(judged_, good, [](const auto& p) { return p.error_m; });
    const auto degrees = collect(judged_, good, [](const auto& p) { return p.error_deg; });
    at_most("error when right, median", quantile(metres, 0.5), "m", 0.015);
    at_most("error when right, p95", quantile(metres, 0.95), "m", 0.06);
    at_most("error when right, median", quantile(degrees, 0.5), "deg", 0.06);
    at_most("error when right, p95", quantile(degrees, 0.95), "deg", 0.3);
    const auto times = collect(
        judged_, [](const auto&) { return true; }, [](const auto& p) { return p.result.match_ms; });
    at_most("time of one match, median", quantile(times, 0.5), "ms", 80.0);
    at_most("time of one match, p95", quantile(times, 0.95), "ms", 200.0);
  }

 private:
  void add(const std::string& name, double value, const char* unit, const Bar& bar) {
    report_.rows.push_back({name, value, unit, has_bars_ ? std::optional(bar) : std::nullopt, {}});
  }

  void at_most(const std::string& name, double value, const char* unit, double bar) {
    const std::string row = fmt::format("{}: {}", path_, name);
    add(row, value, unit, {Bar::Side::at_most, bar});
  }

  void write_bin(const std::string& kind, const OverlapBin& bin) {
    std::size_t all = 0, right = 0;
    for (const JudgedPair& p : judged_) {
      if (p.pair->kind != kind || p.pair->overlap < bin.from || p.pair->overlap >= bin.to) continue;
      ++all;
      right += p.result.accepted() && p.right() ? 1U : 0U;
    }
    if (all == 0) return;
    const std::string row = fmt::format("{}: {}, overlap {:.2f} to {:.2f}, right of {}", path_,
                                        kind, bin.from, std::min(bin.to, 1.0), all);
    const double share = 100.0 * static_cast<double>(right) / static_cast<double>(all);
    add(row, share, "%", {Bar::Side::at_least, bin.least_right});
  }

  void write_wrong(const std::string& kind) {
    const auto all = std::count_if(judged_.begin(), judged_.end(),
                                   [&](const JudgedPair& p) { return p.pair->kind == kind; });
    if (all == 0) return;
    const auto wrong = std::count_if(judged_.begin(), judged_.end(), [&](const JudgedPair& p) {
      return p.pair->kind == kind && p.result.accepted() && !p.right();
    });
    at_most(fmt::format("{}, merged wrongly of {}", kind, all), static_cast<double>(wrong), "",
            0.0);
  }

  const char* path_;
  bool has_bars_;
  const Judged& judged_;
  Report& report_;
};

struct Options {
  std::optional<std::filesystem::path> out;
  std::filesystem::path pairs = "../shared/data/mapmerge/pairs";
  std::filesystem::path plans = "../shared/data/floorplans/houseexpo";
  std::optional<std::size_t> negatives;
};

int run_pairs(const Options& options) {
  Result<std::vector<MergePair>> loaded = simulate_pairs(0);
  const bool recorded = std::filesystem::exists(options.pairs / "index.csv");
  loaded = recorded ? load_pairs(options.pairs) : simulate_pairs(12);
  if (!loaded) {
    fmt::print(stderr, "lifeline-bench: {}\n", loaded.error().text);
    return 1;
  }
  Report report{"merge", describe_machine(), {}};
  for (const auto method : {matching::Method::oriented, matching::Method::spectra}) {
    matching::MatchConfig config;
    config.method = method;
    Judged judged;
    for (const MergePair& pair : *loaded) judged.push_back(judge_pair(pair, config));
    PathReport(matching::to_string(method), method == matching::Method::oriented, judged, report)
        .write();
  }
  return finish(report, options.out);
}

int run_hard_negatives(const Options& options) {
  const NegativesOutcome outcome = run_negatives(*options.negatives, options.plans, {});
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
  CLI::App app("How often two maps are merged rightly, wrongly or not at all.", "merge");
  Options options;
  app.add_option("--out", options.out, "the figures as JSON");
  app.add_option("--pairs", options.pairs, "folder of pairs with an index.csv");
  app.add_option("--plans", options.plans, "folder of HouseExpo plans");
  app.add_option("--negatives", options.negatives, "pairs that must not be merged")
      ->expected(0, 1)
      ->default_str("10000");
  std::vector<std::string> words(arguments.rbegin(), arguments.rend());
  try {
    app.parse(words);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  }
  return options.negatives ? run_hard_negatives(options) : run_pairs(options);
}

}  // namespace lifeline::bench
