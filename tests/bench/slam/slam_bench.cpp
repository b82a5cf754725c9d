#include "tests/bench/slam/slam_bench.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "agents/sources/open_source.hpp"
#include "tests/bench/command_line.hpp"
#include "tests/bench/slam/fault_walks.hpp"
#include "tests/bench/slam/slam_judge.hpp"

namespace lifeline::bench {
namespace {

using std::filesystem::path;

struct SlamOptions {
  std::optional<path> out;
  std::optional<path> pictures;
  path data = "../shared/data";
  std::string only;
  bool quick = false;
};

const std::vector<std::string> kMatchers{kDefaultMatcher, "advanced", "conventional"};

/// A folder for what the runs write, gone with the object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "lifeline_bench.XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw std::filesystem::filesystem_error("no temporary folder", name,
                                              std::error_code(errno, std::generic_category()));
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const path& get() const { return path_; }
  /// Removes what the run before left behind.
  void empty() const {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directory(path_);
  }

 private:
  path path_;
};

class SlamBench {
 public:
  SlamBench(SlamOptions options, path agent)
      : options_(std::move(options)), agent_(std::move(agent)) {
    report_.bench = "slam";
    report_.machine = describe_machine();
  }

  Report run() {
    for (const LogCase& log : log_cases(options_.data)) {
      for (const std::string& matcher : matchers()) play_log(log, matcher);
    }
    const auto plans = spread_plans(options_.data, options_.quick ? 4 : 20);
    play_walks("walks", plans, kDefaultMatcher, options_.quick ? 30 : 120, "");
    for (const std::string& matcher : matchers()) {
      play_walks("walks past doors", plans, matcher, options_.quick ? 30 : 60, "&doors=beside");
    }
    play_faults(plans);
    return std::move(report_);
  }

 private:
  /// In this process: what is done to a scan is nothing that a source could be asked for.
  void play_faults(const std::vector<path>& plans) {
    if (plans.empty()) return;
    std::vector<std::vector<sensing::RawScan>> walks;
    for (const Fault& fault : all_faults()) {
      if (!wanted("faults, " + fault.name)) continue;
      if (walks.empty()) walks = read_walks(plans);
      fmt::print(stderr, "faults, {}\n", fault.name);
      add(fault_rows(fault, walks));
    }
  }
  /// Long enough to come back to where the walk has been.
  [[nodiscard]] std::vector<std::vector<sensing::RawScan>> read_walks(
      const std::vector<path>& plans) const {
    std::vector<std::vector<sensing::RawScan>> walks;
    for (const path& plan : plans) {
      auto source = sources::open_source(fmt::format("sim:{}?duration={}&beams=360&head=natural",
                                                     plan.string(), options_.quick ? 80 : 160));
      if (!source) continue;
      std::vector<sensing::RawScan> walk;
      for (auto scan = (*source)->next(); scan && *scan; scan = (*source)->next()) {
        walk.push_back(**std::move(scan));
      }
      if (walk.size() > 2) walks.push_back(std::move(walk));
    }
    return walks;
  }

  [[nodiscard]] std::vector<std::string> matchers() const {
    return options_.quick ? std::vector<std::string>{kDefaultMatcher} : kMatchers;
  }
  [[nodiscard]] bool wanted(const std::string& name) const {
    return name.find(options_.only) != std::string::npos;
  }

  Result<SlamOutcome> play(const std::string& name, const std::string& source,
                           const std::string& matcher) {
    fmt::print(stderr, "{}\n", name);
    scratch_.empty();
    auto run = run_slam({agent_, scratch_.get(), source, matcher});
    if (!run) {
      fmt::print(stderr, "  failed: {}\n", run.error().text);
      return run;
    }
    if (!options_.pictures) return run;
    std::string file = name + ".png";
    for (char& letter : file) {
      if (letter == ' ' || letter == ',' || letter == '/') letter = '_';
    }
    if (auto drawn = draw_run(*options_.pictures / file, *run, name); !drawn) {
      fmt::print(stderr, "  no picture: {}\n", drawn.error().text);
    }
    return run;
  }

  void play_log(const LogCase& log, const std::string& matcher) {
    const std::string name = fmt::format("{}, {}", log.name, matcher);
    if (!wanted(name)) return;
    add(judge_log(log, matcher, play(name, log.source, matcher)));
  }

  void play_walks(const std::string& kind, const std::vector<path>& plans,
                  const std::string& matcher, int duration_s, const std::string& more) {
    const std::string name = fmt::format("{}, {}", kind, matcher);
    if (plans.empty() || !wanted(name)) return;
    std::vector<std::optional<WalkFigures>> walks;
    for (const path& plan : plans) {
      const std::string source = fmt::format("sim:{}?duration={}&hz=10&beams=1600&head=natural{}",
                                             plan.string(), duration_s, more);
      const std::string run_name = fmt::format("{}, {}", name, plan.stem().string().substr(0, 8));
      const auto run = play(run_name, source, matcher);
      const auto figures = run ? judge_walk(*run) : forward_error(run);
      walks.push_back(figures ? std::optional(*figures) : std::nullopt);
      if (!figures) continue;
      fmt::print(stderr, "  rmse {:.4f} m, worst {:.3f} m, {:.4f} deg/m, {:.2f} ms (p99 {:.2f})\n",
                 figures->rmse_m, figures->worst_m, figures->drift_deg_per_m,
                 figures->step_ms_median, figures->step_ms_p99);
    }
    const bool has_bars = matcher == kDefaultMatcher;
    if (more.empty()) add(accuracy_rows(name, walks, has_bars));
    add({tracking_row(name, walks, has_bars)});
  }

  void add(std::vector<ReportRow> rows) {
    for (ReportRow& row : rows) report_.rows.push_back(std::move(row));
  }

  SlamOptions options_;
  path agent_;
  ScratchFolder scratch_;
  Report report_;
};

/// The exit status, where the arguments say to stop here.
std::optional<int> parse(std::span<const char* const> arguments, SlamOptions& options) {
  CommandLine line("One helmet's accuracy, speed and memory on recordings and simulated walks",
                   "slam");
  line.add_out(options.out);
  line.add("--pictures", options.pictures, "Folder for a picture of every run");
  line.add("--data", options.data, "Folder of recordings and plans");
  line.add("--only", options.only, "Only runs whose name holds this text");
  line.add_flag("--quick", options.quick, "Default matcher, four plans, short walks");
  return line.parse(arguments);
}

}  // namespace

int run_slam_bench(std::span<const char* const> arguments) {
  SlamOptions options;
  if (const auto status = parse(arguments, options)) return *status;
  const path agent = std::filesystem::canonical("/proc/self/exe").parent_path() / "lifeline-agent";
  if (!std::filesystem::exists(agent)) {
    fmt::print(stderr, "lifeline bench: {}: no such file\n", agent.string());
    return 1;
  }
  if (options.pictures) std::filesystem::create_directories(*options.pictures);
  const Report report = SlamBench(options, agent).run();
  if (report.rows.empty()) {
    fmt::print(stderr,
               "lifeline bench: nothing to play: no run's name holds '{}', or {} is not there\n",
               options.only, options.data.string());
    return 1;
  }
  return finish(report, options.out);
}

}  // namespace lifeline::bench
