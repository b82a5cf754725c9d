#include "agents/sources/ros2_source.hpp"

#include <utility>

#include "agents/sources/joined_source.hpp"
#include "agents/sources/ros2_options.hpp"
#include "agents/sources/ros2_receiver.hpp"

namespace lifeline::sources {
namespace {

class Ros2Scans final : public sensing::ScanSource {
 public:
  Ros2Scans(std::shared_ptr<Ros2Receiver> receiver, std::int64_t most)
      : receiver_(std::move(receiver)), most_(most) {}

  Result<std::optional<sensing::RawScan>> next() override {
    if (most_ > 0 && given_ == most_) return std::nullopt;
    ++given_;
    return receiver_->next_scan();
  }

 private:
  std::shared_ptr<Ros2Receiver> receiver_;
  const std::int64_t most_;
  std::int64_t given_ = 0;
};

class Ros2Attitudes final : public sensing::AttitudeSource {
 public:
  explicit Ros2Attitudes(std::shared_ptr<Ros2Receiver> receiver) : receiver_(std::move(receiver)) {}

  Result<sensing::AttitudeRead> next(SteadyTime deadline) override {
    return receiver_->next_orientation(deadline);
  }
  [[nodiscard]] sensing::AttitudeHealth health() const override {
    return receiver_->attitude_health();
  }

 private:
  std::shared_ptr<Ros2Receiver> receiver_;
};

}  // namespace

Result<std::unique_ptr<sensing::ScanSource>> open_ros2_source(const SourceSpec& spec,
                                                              const std::stop_token& stop) {
  const auto options = read_ros2_options(spec);
  if (!options) return forward_error(options);
  auto subscriber =
      dds::RawSubscriber::open({options->domain, options->qos, "lifeline_ros2_source"},
                               "ros2_participant", ros2_topics(*options));
  if (!subscriber) return forward_error(subscriber);
  auto receiver = std::make_shared<Ros2Receiver>(*std::move(subscriber), *options, stop);
  auto scans = std::make_unique<Ros2Scans>(receiver, options->scans);
  if (options->imu.empty()) return scans;
  return std::make_unique<JoinedSource>(std::move(scans),
                                        std::make_unique<Ros2Attitudes>(std::move(receiver)));
}

}  // namespace lifeline::sources
