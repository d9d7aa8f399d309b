#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace nacre {

/// Memory that is taken in pieces and given back all at once: to itself by `clear`, to the system
/// at its end. What is not touched costs nothing (past some
/// 3 MB, what comes in large pages, 2 MB), and what the system has is free for others at
/// once.
class ChunkArena {
 public:
  /// @param size  bytes, at most 64 kB
  /// @return      uninitialised, aligned to 16 bytes
  void* allocate(std::size_t size);

  /// Takes back all that was allocated, and keeps the memory for what comes next.
  void clear();

 private:
  struct Free {
    std::size_t size = 0;
    void operator()(std::byte* block) const noexcept;
  };
  using Block = std::unique_ptr<std::byte[], Free>;

  static Block allocate_block(std::size_t size);
  std::size_t next_block_size() const;

  std::vector<Block> blocks_;
  std::size_t used_blocks_ = 0;
  std::byte* cursor_ = nullptr;
  std::byte* end_ = nullptr;
};

}  // namespace nacre
