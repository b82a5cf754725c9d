#pragma once

#include <deque>
#include <optional>
#include <string>

#include "common/bag/message_source.hpp"
#include "common/recording/recorder.hpp"

namespace lifeline {

/// What a recorder has written of a mission that goes on: of our own topics, those that a replay
/// needs. One owner; any thread.
class RecordedSoFar final : public bag::MessageSource {
 public:
  /// `recorder` must outlive it.
  explicit RecordedSoFar(Recorder& recorder)
      : recorder_(recorder), target_(recorder.folder().string()) {}

  /// unavailable once the recording is closed.
  [[nodiscard]] Result<std::optional<bag::Message>> next() override;
  [[nodiscard]] Result<std::optional<Span>> span() const override { return recorder_.span(); }
  [[nodiscard]] const std::string& target() const override { return target_; }

 private:
  Recorder& recorder_;
  std::string target_;
  std::uint64_t after_ = 0;
  std::deque<bag::Message> waiting_;
};

}  // namespace lifeline
