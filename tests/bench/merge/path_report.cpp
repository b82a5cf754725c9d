#include "tests/bench/merge/path_report.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace lifeline::bench {
namespace {

struct OverlapBin {
  double from, to;
  double least_right;  ///< per cent that the default path must merge rightly
  const char* others;
};
// Others' figures: pairs of other buildings and draws, by intended overlap of 15, 25, 40 and 60 %.
constexpr OverlapBin kSame[] = {
    {0.0, 0.2, 40.0, "m-explore 0, Carpin 0, oriented prototype 56 %"},
    {0.2, 0.3, 80.0, "m-explore 0 (confidence 0.3: 5), Carpin 0, prototype 85 %"},
    {0.3, 0.4, 95.0, "m-explore 2 (confidence 0.3: 36), Carpin 4, prototype 98 %"},
    {0.4, 1.01, 98.0, "m-explore 17 (confidence 0.3: 69), Carpin 26, prototype 98 %"}};
constexpr OverlapBin kDrift[] = {{0.3, 1.01, 60.0, "prototype 37 to 44 %"}};

using Which = std::function<bool(const JudgedPair&)>;
using Value = std::function<double(const JudgedPair&)>;
using Figure = std::function<double(const Judged&)>;

bool merged_rightly(const JudgedPair& p) {
  return p.result.accepted() && p.right();
}

Figure percentile(Which which, Value value, double share) {
  return [=](const Judged& judged) {
    std::vector<double> values;
    for (const JudgedPair& pair : judged) {
      if (which(pair)) values.push_back(value(pair));
    }
    return quantile(std::move(values), share);
  };
}

class SideBySide {
 public:
  SideBySide(const Judged& oriented, const Judged& spectra, Report& report)
      : oriented_(oriented), spectra_(spectra), report_(report) {}

  void add(const std::string& name, const char* unit, const Bar& bar, const std::string& reference,
           const Figure& figure) {
    report_.rows.push_back({name, figure(oriented_), unit, bar, reference});
    report_.rows.push_back({name + ": spectra", figure(spectra_), unit, {}, "the paper's path"});
  }

  void add_bin(const std::string& kind, const OverlapBin& bin) {
    const auto in_bin = [&](const JudgedPair& p) {
      return p.pair->kind == kind && p.pair->overlap >= bin.from && p.pair->overlap < bin.to;
    };
    const std::size_t all = count_pairs(oriented_, in_bin);
    if (all == 0) return;
    add(fmt::format("{}, overlap {:.2f} to {:.2f}, right of {}", kind, bin.from,
                    std::min(bin.to, 1.0), all),
        "%", {Bar::Side::at_least, bin.least_right}, bin.others, [&](const Judged& judged) {
          const std::size_t right = count_pairs(
              judged, [&](const JudgedPair& p) { return in_bin(p) && merged_rightly(p); });
          return 100.0 * static_cast<double>(right) / static_cast<double>(all);
        });
  }

  void add_wrong(const std::string& kind, const std::string& others) {
    const std::size_t all =
        count_pairs(oriented_, [&](const JudgedPair& p) { return p.pair->kind == kind; });
    if (all == 0) return;
    add(fmt::format("{}, merged wrongly of {}", kind, all), "", {Bar::Side::at_most, 0.0}, others,
        [&](const Judged& judged) {
          return static_cast<double>(count_pairs(judged, [&](const JudgedPair& p) {
            return p.pair->kind == kind && p.result.accepted() && !p.right();
          }));
        });
  }

 private:
  const Judged& oriented_;
  const Judged& spectra_;
  Report& report_;
};

}  // namespace

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  return values[std::min(values.size() - 1, at)];
}

std::size_t count_pairs(const Judged& judged, const Which& which) {
  return static_cast<std::size_t>(std::count_if(judged.begin(), judged.end(), which));
}

void write_side_by_side(const Judged& oriented, const Judged& spectra, Report& report) {
  SideBySide rows(oriented, spectra, report);
  for (const OverlapBin& bin : kSame) rows.add_bin("same", bin);
  for (const OverlapBin& bin : kDrift) rows.add_bin("drift10_", bin);
  rows.add_wrong("same", "");
  rows.add_wrong("drift10_", "");
  rows.add_wrong("different", "m-explore 0 of 176 (confidence 0.3: 1 of 72), prototype 0 of 176");
  rows.add_wrong("disjoint", "");

  const Which good = [](const JudgedPair& p) {
    return p.pair->kind == "same" && merged_rightly(p);
  };
  const Value metres = [](const JudgedPair& p) { return p.error_m; };
  const Value degrees = [](const JudgedPair& p) { return p.error_deg; };
  const auto at_most = [](double limit) { return Bar{Bar::Side::at_most, limit}; };
  rows.add("error when right, median", "m", at_most(0.015), "prototype 0.015",
           percentile(good, metres, 0.5));
  rows.add("error when right, p95", "m", at_most(0.06), "prototype 0.11",
           percentile(good, metres, 0.95));
  rows.add("error when right, median", "deg", at_most(0.06), "prototype 0.06",
           percentile(good, degrees, 0.5));
  rows.add("error when right, p95", "deg", at_most(0.3), "prototype 0.46",
           percentile(good, degrees, 0.95));
  const Which any = [](const JudgedPair&) { return true; };
  const Value time = [](const JudgedPair& p) { return p.result.match_ms; };
  rows.add("time of one match, median", "ms", at_most(80.0),
           "m-explore 683, Carpin 451, prototype 221", percentile(any, time, 0.5));
  rows.add("time of one match, p95", "ms", at_most(200.0),
           "m-explore 1099, Carpin 772, prototype 386", percentile(any, time, 0.95));
}

}  // namespace lifeline::bench
