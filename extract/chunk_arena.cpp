#include "extract/chunk_arena.h"

#include <algorithm>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace nacre {
namespace {

constexpr std::size_t kFirstBlock = std::size_t{1} << 16;
constexpr std::size_t kLargestBlock = std::size_t{1} << 18;
constexpr std::size_t kAlignment = 16;

}  // namespace

#ifdef __linux__

// Not malloc: it would keep blocks for later, and they are a good part of a surface's size.
ChunkArena::Block ChunkArena::allocate_block(std::size_t size) {
  void* block = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (block == MAP_FAILED) throw std::bad_alloc();
  return Block(static_cast<std::byte*>(block), Free{size});
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

void* ChunkArena::allocate(std::size_t size) {
  const std::size_t padded = (size + kAlignment - 1) / kAlignment * kAlignment;
  if (static_cast<std::size_t>(end_ - cursor_) < padded) {
    if (used_blocks_ == blocks_.size()) {
      const std::size_t wanted =
          blocks_.empty() ? kFirstBlock : 2 * blocks_.back().get_deleter().size;
      blocks_.push_back(allocate_block(std::min(wanted, kLargestBlock)));
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
