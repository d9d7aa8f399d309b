#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string_view>

namespace nacre {

/// Told about long work: a stage's name ("extract") and the done part of it, 0 to 1.
///
/// May be empty. Called from any thread, but never from two at a time.
using ProgressCallback = std::function<void(std::string_view stage, double fraction)>;

/// Counts the steps of one stage of work from many threads, and reports about every hundredth.
class ProgressMeter {
 public:
  /// Reports 0 at once.
  ProgressMeter(ProgressCallback callback, std::string_view stage, std::size_t steps);

  /// Reports 1.
  ~ProgressMeter();

  ProgressMeter(const ProgressMeter&) = delete;
  ProgressMeter& operator=(const ProgressMeter&) = delete;

  /// Safe to call from any thread.
  void advance(std::size_t steps = 1);

 private:
  ProgressCallback callback_;
  std::string_view stage_;
  std::size_t steps_;
  std::atomic<std::size_t> done_{0};
  std::atomic<std::size_t> reported_hundredths_{0};
  std::mutex reporting_;
};

}  // namespace nacre
