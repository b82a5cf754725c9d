// Any bytes as what an RPLIDAR sends: answers and frames of every format. The first byte says which
// format and how the rest is cut into reads.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "agents/rplidar/protocol.hpp"
#include "agents/rplidar/sample_decoder.hpp"
#include "agents/rplidar/sweep_assembler.hpp"

namespace {

using namespace lifeline;
using namespace lifeline::rplidar;

void require(bool condition) {
  if (!condition) std::abort();
}

void find_answers(Bytes bytes, std::size_t cut) {
  for (const AnswerType type : {AnswerType::info, AnswerType::health, AnswerType::lidar_conf,
                                AnswerType::express_capsules}) {
    AnswerFinder finder(type);
    bool found = false;
    for (std::size_t at = 0; at < bytes.size() && !found; at += cut) {
      found = finder.push(bytes.subspan(at, std::min(cut, bytes.size() - at)));
    }
    if (!found) continue;
    const Bytes answer = finder.answer();
    require(answer.size() + finder.rest().size() <= bytes.size());
    (void)parse_info(answer);
    (void)parse_health(answer);
    (void)parse_accessory_flag(answer);
    if (const auto value = conf_value(answer, ConfEntry::mode_name)) {
      require(parse_name(*value).size() <= 32);
    }
  }
}

void check(const sensing::RawScan& scan) {
  require(scan.ranges_m.size() >= 90 && scan.ranges_m.size() <= 8192);
  require(std::isfinite(scan.first_angle_rad) && std::isfinite(scan.angle_step_rad));
  require(scan.sweep_time > Duration{0} && scan.sweep_time < std::chrono::seconds(100));
  for (const float range_m : scan.ranges_m) require(range_m >= 0.0F && range_m < 66.0F);
}

void decode(AnswerType type, Bytes bytes, std::size_t cut) {
  if (!frame_format(type)) return;
  constexpr double kUsPerSample = 63.0;
  SampleDecoder decoder(type, kUsPerSample, 256'000);
  SweepSettings settings;
  settings.us_per_sample = kUsPerSample;
  SweepAssembler assembler(settings);
  std::vector<Sample> samples;
  SteadyTime now(std::chrono::seconds(1));
  for (std::size_t at = 0; at < bytes.size(); at += cut) {
    samples.clear();
    now += std::chrono::microseconds(500);
    decoder.push(bytes.subspan(at, std::min(cut, bytes.size() - at)), now, samples);
    for (const Sample& sample : samples) {
      require(sample.reading.angle_q16 >= 0 && sample.reading.angle_q16 < kTurn_q16);
      require(sample.reading.distance_quarters <= 4 * 65'535);
      require(sample.taken < now);
      if (const auto scan = assembler.add(sample)) check(*scan);
    }
  }
  require(decoder.counts().bytes == bytes.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr AnswerType kFormats[] = {AnswerType::standard_nodes, AnswerType::express_capsules,
                                     AnswerType::dense_capsules, AnswerType::ultra_capsules};
  const Bytes bytes(data + 1, size - 1);
  const std::size_t cut = 1 + (data[0] >> 2) * 5U;
  find_answers(bytes, cut);
  decode(kFormats[data[0] & 3], bytes, cut);
  return 0;
}
