#pragma once

#include <cstddef>
#include <optional>

namespace nacre {

/// Watches how much memory this process takes beyond what it had.
///
/// Resident bytes, whatever holds them: heap, libraries loaded meanwhile, drivers. The allocator is
/// asked to give back what is free first, so that what an earlier step left does not hide in it.
class MemoryWatch {
 public:
  MemoryWatch();

  /// Peak of the resident memory since this was made, less what was resident then, bytes; nothing
  /// where the system does not tell (it needs Linux's /proc).
  std::optional<std::size_t> peak_bytes() const;

 private:
  std::optional<std::size_t> before_;
};

}  // namespace nacre
