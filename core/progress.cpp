#include "core/progress.h"

#include <algorithm>
#include <utility>

namespace nacre {

ProgressMeter::ProgressMeter(ProgressCallback callback, std::string_view stage, std::size_t steps)
    : callback_(std::move(callback)), stage_(stage), steps_(std::max<std::size_t>(steps, 1)) {
  if (callback_) callback_(stage_, 0.0);
}

ProgressMeter::~ProgressMeter() {
  if (callback_) callback_(stage_, 1.0);
}

void ProgressMeter::advance(std::size_t steps) {
  if (!callback_) return;
  const std::size_t done = done_.fetch_add(steps) + steps;
  const std::size_t hundredths = 100 * done / steps_;
  if (hundredths <= reported_hundredths_.load()) return;
  // Whoever does not get the lock leaves the telling to the one who has it.
  const std::unique_lock lock(reporting_, std::try_to_lock);
  if (!lock || hundredths <= reported_hundredths_.load()) return;
  reported_hundredths_ = hundredths;
  callback_(stage_, static_cast<double>(hundredths) / 100.0);
}

}  // namespace nacre
