#include "extract/chunk_arena.h"

#include <algorithm>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace nacre {
namespace {

constexpr std::size_t kLargestBlock = std::size_t{1} << 21;
constexpr std::size_t kAlignment = 16;

std::byte* allocate_block(std::size_t size) {
  const bool huge = size == kLargestBlock;
  void* block = huge ? std::aligned_alloc(kLargestBlock, size) : std::malloc(size);
  if (block == nullptr) throw std::bad_alloc();
#ifdef __linux__
  // Advice only: without it everything works, with more page faults.
  if (huge) static_cast<void>(madvise(block, size, MADV_HUGEPAGE));
#endif
  return static_cast<std::byte*>(block);
}

}  // namespace

void ChunkArena::Free::operator()(std::byte* block) const noexcept { std::free(block); }

void* ChunkArena::allocate(std::size_t size) {
  const std::size_t padded = (size + kAlignment - 1) / kAlignment * kAlignment;
  if (static_cast<std::size_t>(end_ - cursor_) < padded) {
    blocks_.emplace_back(allocate_block(next_block_));
    cursor_ = blocks_.back().get();
    end_ = cursor_ + next_block_;
    size_ += next_block_;
    next_block_ = std::min(2 * next_block_, kLargestBlock);
  }
  std::byte* allocated = cursor_;
  cursor_ += padded;
  return allocated;
}

}  // namespace nacre
