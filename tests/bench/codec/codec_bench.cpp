#include "tests/bench/codec/codec_bench.hpp"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/base/quantile.hpp"
#include "idl/config.pb.h"
#include "tests/bench/codec/codec_walk.hpp"
#include "tests/bench/command_line.hpp"
#include "tests/bench/report.hpp"

namespace lifeline::bench {
namespace {

constexpr double kFinalBar = 35.0, kAllBar = 150.0;  // octets a known square metre

struct CodecOptions {
  std::optional<std::filesystem::path> out, config;
  std::filesystem::path data = "../shared/data";
  std::string only;
};

struct CodecCase {
  std::string name, source;
};

std::vector<CodecCase> cases_of(const CodecOptions& options) {
  std::vector<CodecCase> cases;
  for (const char* name : {"intel", "aces", "csail", "seattle", "edmonton", "acapulco"}) {
    const auto log = options.data / "carmen" / (std::string(name) + "-rawodom.log.gz");
    if (!std::filesystem::exists(log)) continue;
    cases.push_back({name, fmt::format("carmen:{}?prior=odom", log.string())});
  }
  cases.push_back({"simulated office", "sim:office?seed=21"});
  std::erase_if(cases, [&](const CodecCase& each) {
    return each.name.find(options.only) == std::string::npos;
  });
  return cases;
}

void write_way(const std::string& name, const CodecWalk& walk, const SharingCost& cost, bool bars,
               Report& report) {
  const auto bar = [&](double limit) {
    return bars ? std::optional<Bar>(Bar{Bar::Side::at_most, limit}) : std::nullopt;
  };
  const auto add = [&](const std::string& what, double value, const char* unit,
                       std::optional<Bar> limit = {}, std::string reference = {}) {
    report.rows.push_back({name + ": " + what, value, unit, limit, std::move(reference)});
  };
  const double m2 = walk.known_m2;
  add("final map", cost.final_octets / m2, "B/m2", bar(kFinalBar),
      bars ? "8-bit TSD under zstd -19: 36-70" : "");
  add("all revisions, with their envelopes", cost.all_octets / m2, "B/m2", bar(kAllBar),
      fmt::format("{} of {} tiles", cost.revisions, cost.tiles));
  add("the same with headers, each receiver", cost.on_air_octets / m2, "B/m2");
  add("mean rate, each receiver", cost.on_air_octets / walk.lasted_s, "B/s");
  add("a square metre waits", cost.lacked_m2_s / m2, "s");
}

void write_rows(const std::string& name, const CodecWalk& walk, Report& report) {
  write_way(fmt::format("{}, {:.0f} m2", name, walk.known_m2), walk, walk.coarse, true, report);
  write_way(name + ", fine", walk, walk.fine, false, report);
  for (const auto& [rival, octets] : walk.fine.rivals) {
    report.rows.push_back(
        {fmt::format("{}, {}: final map", name, rival), octets.first / walk.known_m2, "B/m2"});
    report.rows.push_back({fmt::format("{}, {}: the revisions of fine", name, rival),
                           octets.second / walk.known_m2, "B/m2"});
  }
  for (const auto& [what, ms] :
       {std::pair("encode", &walk.encode_ms), std::pair("decode", &walk.decode_ms)}) {
    report.rows.push_back(
        {fmt::format("{}: {} a tile, median", name, what), quantile(*ms, 0.5), "ms"});
    report.rows.push_back(
        {fmt::format("{}: {} a tile, p99", name, what), quantile(*ms, 0.99), "ms"});
  }
}

int run(const CodecOptions& options) {
  const auto config = read_agent_config(options.config, std::nullopt);
  if (!config) {
    fmt::print(stderr, "lifeline-bench: {}\n", config.error().text);
    return 2;
  }
  Report report{"codec", describe_machine(), {}};
  for (const CodecCase& each : cases_of(options)) {
    fmt::print(stderr, "lifeline-bench: {}\n", each.name);
    const auto walk = play_codec_walk(each.source, to_settings(*config));
    if (!walk) {
      fmt::print(stderr, "lifeline-bench: {}\n", walk.error().text);
      return 1;
    }
    write_rows(each.name, *walk, report);
  }
  return finish(report, options.out);
}

}  // namespace

int run_codec_bench(std::span<const char* const> arguments) {
  CommandLine line("What a known square metre costs on the air.", "codec");
  CodecOptions options;
  line.add_out(options.out);
  line.add("--data", options.data, "folder that holds carmen/*.log.gz");
  line.add("--only", options.only, "the walks whose name holds this");
  line.add("--config", options.config, "configuration of the helmet (docs/parameters.md)");
  if (const auto status = line.parse(arguments)) return *status;
  return run(options);
}

}  // namespace lifeline::bench
