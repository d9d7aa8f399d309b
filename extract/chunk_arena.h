#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace nacre {

/// Memory that is taken in pieces and given back all at once.
///
/// Blocks grow from 64 kB to 2 MB; those of 2 MB are asked for as huge pages where the system has
/// them, which spares five hundred page faults each.
class ChunkArena {
 public:
  /// @param size  bytes, at most 64 kB
  /// @return      uninitialised, aligned to 16 bytes
  void* allocate(std::size_t size);

  /// Bytes taken from the system.
  std::size_t size() const { return size_; }

 private:
  struct Free {
    void operator()(std::byte* block) const noexcept;
  };

  std::vector<std::unique_ptr<std::byte[], Free>> blocks_;
  std::byte* cursor_ = nullptr;
  std::byte* end_ = nullptr;
  std::size_t next_block_ = std::size_t{1} << 16;
  std::size_t size_ = 0;
};

}  // namespace nacre
