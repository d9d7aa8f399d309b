#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace nacre {

/// Bytes that are read by place: a file, of which only what is asked for is read, or memory.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  virtual std::uint64_t size() const noexcept = 0;

  /// Copies `size` bytes from `offset` on; safe from several threads.
  /// @pre  offset + size <= size(), without overflow: check before allocating
  /// @throws Error  BadFile if the bytes cannot be read
  virtual std::vector<std::byte> read(std::uint64_t offset, std::size_t size) const = 0;
};

/// A regular file.
class FileSource final : public ByteSource {
 public:
  /// @throws Error  BadFile if it is no regular file or cannot be opened
  explicit FileSource(const std::filesystem::path& path);
  ~FileSource() override;

  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;

  std::uint64_t size() const noexcept override { return size_; }
  std::vector<std::byte> read(std::uint64_t offset, std::size_t size) const override;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Bytes that outlive this view of them.
class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::uint64_t size() const noexcept override { return bytes_.size(); }
  std::vector<std::byte> read(std::uint64_t offset, std::size_t size) const override {
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(offset);
    return {begin, begin + static_cast<std::ptrdiff_t>(size)};
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace nacre
