#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

namespace nacre {

/// A file without a name, for what need not stand in memory: gone with its owner, also one that is
/// killed.
class ScratchFile {
 public:
  /// @param folder  on whose file system it lies
  /// @return        none where no such file can be made
  static std::optional<ScratchFile> create(const std::filesystem::path& folder);

  /// Room for this many bytes; safe to call from any thread, as all that follows.
  /// @return  where they begin
  std::uint64_t reserve(std::uint64_t size) { return size_->fetch_add(size); }

  /// @return  whether the bytes could be written (a full disk)
  bool write(std::uint64_t offset, std::span<const std::byte> bytes);

  /// Reads what was written.
  /// @throws Error  Unsupported if it cannot be read back
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  class Descriptor {
   public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor();
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const noexcept { return number_; }

   private:
    int number_;
  };

  explicit ScratchFile(int descriptor)
      : descriptor_(std::make_unique<Descriptor>(descriptor)),
        size_(std::make_unique<std::atomic<std::uint64_t>>(0)) {}

  std::unique_ptr<Descriptor> descriptor_;
  std::unique_ptr<std::atomic<std::uint64_t>> size_;
};

}  // namespace nacre
