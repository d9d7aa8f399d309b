#include "extract/chunk_arena.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace nacre {
namespace {

constexpr std::size_t kFirstBlock = std::size_t{1} << 16;
constexpr std::size_t kLargestBlock = std::size_t{1} << 18;
constexpr std::size_t kLargePage = std::size_t{1} << 21;
/// Once there are so many blocks, some 3 MB, what follows comes in large pages: less than half the
/// cost for each byte touched, and all streams of a slab within reach of the processor's page
/// table cache. Smaller slabs would not fill one.
constexpr std::size_t kBlocksBeforeLargePages = 12;
constexpr std::size_t kAlignment = 16;

}  // namespace

#ifdef __linux__

namespace {

std::byte* map_memory(std::size_t size) {
  void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return static_cast<std::byte*>(memory);
}

/// Memory of one large page's size and place, which the system makes one where it can.
std::byte* map_large_page() {
  std::byte* memory = map_memory(2 * kLargePage);
  const std::size_t before =
      (kLargePage - std::bit_cast<std::uintptr_t>(memory) % kLargePage) % kLargePage;
  if (before > 0) munmap(memory, before);
  munmap(memory + before + kLargePage, kLargePage - before);
  madvise(memory + before, kLargePage, MADV_HUGEPAGE);
  return memory + before;
}

}  // namespace

// Not malloc: it would keep blocks for later, and they are a good part of a surface's size.
ChunkArena::Block ChunkArena::allocate_block(std::size_t size) {
  return Block(size == kLargePage ? map_large_page() : map_memory(size), Free{size});
}

void ChunkArena::Free::operator()(std::byte* block) const noexcept { munmap(block, size); }

#else

ChunkArena::Block ChunkArena::allocate_block(std::size_t size) {
  void* block = std::malloc(size);
  if (block == nullptr) throw std::bad_alloc();
  return Block(static_cast<std::byte*>(block), Free{size});
}

void ChunkArena::Free::operator()(std::byte* block) const noexcept { std::free(block); }

#endif

std::size_t ChunkArena::next_block_size() const {
  if (blocks_.empty()) return kFirstBlock;
  if (blocks_.size() >= kBlocksBeforeLargePages) return kLargePage;
  return std::min(2 * blocks_.back().get_deleter().size, kLargestBlock);
}

void* ChunkArena::allocate(std::size_t size) {
  const std::size_t padded = (size + kAlignment - 1) / kAlignment * kAlignment;
  if (static_cast<std::size_t>(end_ - cursor_) < padded) {
    if (used_blocks_ == blocks_.size()) {
      blocks_.push_back(allocate_block(next_block_size()));
    }
    const Block& block = blocks_[used_blocks_++];
    cursor_ = block.get();
    end_ = cursor_ + block.get_deleter().size;
  }
  std::byte* allocated = cursor_;
  cursor_ += padded;
  return allocated;
}

void ChunkArena::clear() {
  used_blocks_ = 0;
  cursor_ = end_ = nullptr;
}

}  // namespace nacre
